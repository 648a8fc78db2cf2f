// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "example_farm.h"

namespace plotscan::testing {

// Two trials of two rows: 6 plots with two cultivars in random order, and 4 larger plots.
inline std::string first_trial() {
  return "{width_m: 1.5, length_m: 3, gap_width_m: 0.5, gap_length_m: 1, heading_deg: 30, "
         "position_m: [-6, 0], rows: [{plots: 3}, {plots: 3}]}";
}

inline std::string first_plants() {
  return "{count: 12, scale: [0.8, 1.2], design: random, cultivars: [{name: A}, {name: B}], "
         "models: [" +
         (models_folder() / "soybean_1.obj").string() + "]}";
}

inline std::string second_trial() {
  return "{width_m: 2, length_m: 4, gap_width_m: 0.5, gap_length_m: 1, "
         "position_m: [5, 0], rows: [{plots: 2}, {plots: 2}]}";
}

inline std::string second_plants() {
  return "{count: 7, models: [" + (models_folder() / "soybean_2.obj").string() + "]}";
}

inline std::filesystem::path write_trials(const TemporaryFolder& folder) {
  return folder.write("trials.yaml",
                      "terrain: {side_m: 30, vertices: 40, relief_m: 0.4}\n"
                      "trials:\n"
                      "  - plots: " +
                          first_trial() + "\n    plants: " + first_plants() +
                          "\n"
                          "  - plots: " +
                          second_trial() + "\n    plants: " + second_plants() + "\n");
}

}  // namespace plotscan::testing
