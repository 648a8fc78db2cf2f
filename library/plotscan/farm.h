// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plotscan/error.h"
#include "plotscan/export.h"
#include "plotscan/plots.h"
#include "plotscan/progress.h"

namespace plotscan {

struct FarmOptions {
  // key=value in place of the description's, "terrain.relief_m=0.5", "plots.rows.0.plots=5".
  std::vector<std::string> set = {};
  std::optional<std::uint64_t> seed = {};  // else the description's, else 1
  int threads = 0;                         // 0: one for each processor; results are the same
  bool replace = false;                    // a farm that is there
};

// A farm at a glance.
struct FarmSummary {
  std::string name;
  std::uint64_t seed = 0;
  std::size_t plots = 0;
  std::size_t plants = 0;  // of the crop
  std::size_t weeds = 0;
  std::array<double, 2> field_size_m = {};  // bounding rectangle of the plots
  double plant_height_mean_m = 0;           // of the crop
  double plant_height_max_m = 0;            // of the crop
  double leaf_area_index = 0;               // the crop's leaves over the plots' area
};

// What `farmgen generate` does: makes the farm that the description (a YAML file, or the name of a
// shipped one, "paper_half") and the seed determine, and writes its folder (docs/farm-format.md).
// Throws BadInput on a description that does not hold, a mesh that cannot be read, or a folder that
// exists, and leaves nothing behind then.
PLOTSCAN_API FarmSummary generate_farm(const std::filesystem::path& description,
                                       const std::filesystem::path& folder,
                                       const FarmOptions& options = {},
                                       const Progress& progress = {});

// The true plots of a farm folder, or of a GeoJSON file whose plots have numbers height_<name>_m.
// Throws BadInput where there is no plot.
PLOTSCAN_API std::vector<TruePlot> read_truth(const std::filesystem::path& farm);

}  // namespace plotscan
