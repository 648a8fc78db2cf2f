// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "temporary_folder.h"

namespace plotscan::testing {

// A suite of two small farms whose names and seed stand nowhere else.
inline std::filesystem::path write_blind_suite(const TemporaryFolder& folder,
                                               const std::string& more = "") {
  const std::string worlds = std::string(PLOTSCAN_SOURCE_DIR) + "/worlds/";
  return folder.write(
      "blind.yaml",
      "name: blindsuite\ncases:\n"
      "  - {name: zq-even-hidden, farm: " +
          worlds +
          "paper_flat.yaml, set: &small "
          "{terrain.side_m: 30, terrain.vertices: 20, \"plots.rows\": \"[{plots: 4}]\", "
          "plants.count: 30}}\n"
          "  - {name: zq-uneven-hidden, farm: " +
          worlds +
          "paper_half.yaml, set: *small}\n"
          "seeds: [918273646]\n"
          "flight: {altitude_m: 6, speed_m_s: 3, position_drift_m: 0.02}\n"
          "methods: [lattice]\n" +
          more);
}

}  // namespace plotscan::testing
