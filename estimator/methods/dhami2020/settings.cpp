// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/settings.h"

#include "core/trial_layout.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Box = AreaSetting<Options>;
using Flag = FlagSetting<Options>;
using Number = NumberSetting<Options>;
using Whole = WholeSetting<Options>;

}  // namespace

// A table may be long. NOLINTNEXTLINE(readability-function-size)
const std::vector<MethodSetting<Options>>& settings() {
  static const std::vector<MethodSetting<Options>> all = {
      {.key = "plots",
       .flag = "--plots",
       .help =
           "how many plots lie in the field, or in --learn-box (1 to 100000; dhami2020 needs it)",
       .value = Whole{{0, kMostPlots}, member<&Options::plots>},
       .searches = true},
      {.key = "learn_box",
       .flag = "--learn-box",
       .help =
           "x0,y0,x1,y1 in the cloud's units: learn box size and grid in this part of the field, "
           "which has --plots plots, and extend the grid over the whole field",
       .value = Box{member<&Options::learn_box>},
       .searches = true},
      {.key = "voxel_m",
       .flag = "--voxel",
       .help = "edge of the voxel filter's cells, metres",
       .value = Number{{0.005, 1}, member<&Options::voxel_m>}},
      {.key = "min_height_m",
       .flag = "--min-height",
       .help = "points this far above the levelled ground are crop, metres",
       .value = Number{{0, 10}, member<&Options::min_height_m>},
       .searches = true},
      {.key = "level",
       .flag = "--no-level",
       .help = "take z = 0 for the ground instead of levelling the map",
       .value = Flag{member<&Options::level>},
       .searches = true},
      {.key = "orientation_bin_rad",
       .flag = "",
       .help = "bin of the vote for the plots' orientation, radians",
       .value = Number{{0.001, 1.5}, member<&Options::orientation_bin_rad>}},
      {.key = "width_bin_m",
       .flag = "",
       .help = "bin of the vote for their width, metres",
       .value = Number{{0.001, 100}, member<&Options::width_bin_m>}},
      {.key = "length_bin_m",
       .flag = "",
       .help = "bin of the vote for their length, metres",
       .value = Number{{0.001, 100}, member<&Options::length_bin_m>}},
      {.key = "extend_m",
       .flag = "--extend",
       .help = "lengthen each end of a box by this to show the ground, metres",
       .value = Number{{0, 10}, member<&Options::extend_m>}},
      {.key = "plane_tolerance_m",
       .flag = "--plane-tolerance",
       .help = "distance to the ground plane within which RANSAC takes a point for ground, metres",
       .value = Number{{0.001, 1}, member<&Options::plane_tolerance_m>}},
  };
  return all;
}

}  // namespace plotscan::methods::dhami2020
