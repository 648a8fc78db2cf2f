// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plotscan/farm.h"
#include "plotscan/flight.h"
#include "temporary_folder.h"

namespace plotscan::testing {

// 3 x 3 plots of 40 plants on 30 m of flat ground, of the shipped description paper_flat.
inline const std::vector<std::string> kSmall = {"terrain.side_m=30", "plots.rows.0.plots=3",
                                                "plots.rows.1.plots=3", "plots.rows.2.plots=3",
                                                "plants.count=40"};

// The farm and its scan, made once for all tests of a suite: folder/farm, folder/scan.
inline void make_example_scan(const std::filesystem::path& folder) {
  generate_farm("paper_flat", folder / "farm", {.set = kSmall, .seed = 101});
  fly(folder / "farm", folder / "scan", {.settings = {{"speed_m_s", 5.0}}});
}

}  // namespace plotscan::testing
