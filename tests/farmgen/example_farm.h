// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "temporary_folder.h"

namespace plotscan::testing {

inline std::filesystem::path models_folder() {
  return std::filesystem::path(PLOTSCAN_SOURCE_DIR) / "models" / "soybean";
}

// A small farm: two rows of plots on uneven ground.
inline std::string example_description() {
  return "name: example\n"
         "terrain: {side_m: 20, vertices: 40, relief_m: 0.4}\n"
         "plots:\n"
         "  width_m: 1.5\n"
         "  length_m: 3\n"
         "  gap_width_m: 0.5\n"
         "  gap_length_m: 1\n"
         "  heading_deg: 30\n"
         "  position_m: [1, -2]\n"
         "  rows:\n"
         "    - {plots: 3}\n"
         "    - {plots: 2, offset_m: 1}\n"
         "plants:\n"
         "  count: 20\n"
         "  scale: [0.8, 1.2]\n"
         "  models:\n"
         "    - " +
         (models_folder() / "soybean_1.obj").string() +
         "\n"
         "    - " +
         (models_folder() / "soybean_2.obj").string() + "\n";
}

inline std::filesystem::path write_example(const testing::TemporaryFolder& folder) {
  return folder.write("example.yaml", example_description());
}

// The example with some plants that lean, and one outside every plot.
inline std::filesystem::path write_leaning_example(const testing::TemporaryFolder& folder) {
  folder.write("plants.csv",
               "model,x_m,y_m,z_m,scale_x,scale_y,scale_z,yaw_deg,pitch_deg,roll_deg\n"
               "soybean_1,0.5,-2,,1,1.1,1.2,10,20,30\n"
               "soybean_2,1.0,-2.5,0.25,1,1,1,-170,-40,5\n"
               "soybean_2,1.5,-1.5,,0.7,0.8,0.9,45,90,0\n"
               "soybean_1,9,9,,1,1,1,0,0,0\n");
  return folder.write("leaning.yaml",
                      "terrain: {side_m: 20, vertices: 40, relief_m: 0.4}\n"
                      "plots: {width_m: 3, length_m: 3, position_m: [1, -2], rows: [{plots: 1}]}\n"
                      "layout:\n"
                      "  plants: plants.csv\n"
                      "  models:\n"
                      "    - " +
                          (models_folder() / "soybean_1.obj").string() +
                          "\n"
                          "    - " +
                          (models_folder() / "soybean_2.obj").string() + "\n");
}

}  // namespace plotscan::testing
