// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/settings.h"

#include "core/trial_layout.h"
#include "heights/measure_heights.h"

namespace plotscan::methods::lattice {
namespace {

using Flag = FlagSetting<Options>;
using Optional = OptionalSetting<Options>;
using OptionalText = OptionalTextSetting<Options>;
using OptionalWhole = OptionalWholeSetting<Options>;
using Wholes = WholesSetting<Options>;

}  // namespace

// A table may be long. NOLINTNEXTLINE(readability-function-size)
const std::vector<MethodSetting<Options>>& settings() {
  static const std::vector<MethodSetting<Options>> all = {
      {.key = "heading_deg",
       .flag = "--heading",
       .help = "direction of the plots' length, degrees counter-clockwise from x (default: found)",
       .value = Optional{{-360, 360}, member<&Options::heading_deg>},
       .searches = true},
      {.key = "plot_width_m",
       .flag = "--plot-width",
       .help = "width of every plot, metres, no more than its length; plots may lie side by side "
               "without a gap then (default: found)",
       .value = Optional{{0.1, 100}, member<&Options::plot_width_m>},
       .searches = true},
      {.key = "plot_length_m",
       .flag = "--plot-length",
       .help = "length of every plot, metres (default: found)",
       .value = Optional{{0.1, 100}, member<&Options::plot_length_m>},
       .searches = true},
      {.key = "rows",
       .flag = "--rows",
       .help = "number of rows, which follow each other along the plots' length (default: found)",
       .value = OptionalWhole{{1, kMostPlots}, member<&Options::rows>},
       .searches = true},
      {.key = "columns",
       .flag = "--columns",
       .help = "number of columns, along the plots' width (default: found)",
       .value = OptionalWhole{{1, kMostPlots}, member<&Options::columns>},
       .searches = true},
      {.key = "plots",
       .flag = "--plots",
       .help = "how many plots lie in the field, or in --learn-box (dhami2020 needs it)",
       .value = OptionalWhole{{1, kMostPlots}, member<&Options::plots>},
       .searches = true},
      {.key = "crop",
       .flag = "--crop",
       .help = "crop of the field (default: recognised from the canopy)",
       .value = OptionalText{heights::crop_names(), member<&Options::crop>},
       .measures = true},
      {.key = "noise_m",
       .flag = "--noise",
       .help = "sigma of the points' heights (metres; default: estimated from bare ground)",
       .value = Optional{{0, kMostNoise_m}, member<&Options::noise_m>}},
      {.key = "ground_classes",
       .flag = "--ground-class",
       .help = "only points of these ASPRS classes may be ground, separated by commas; 2 is ground "
               "(default: every point may)",
       .value = Wholes{{0, 255}, member<&Options::ground_classes>}},
      {.key = "calibrated",
       .flag = "--no-calibration",
       .help = "report the canopy's own mean and percentiles as the plants'",
       .value = Flag{member<&Options::calibrated>},
       .measures = true},
  };
  return all;
}

}  // namespace plotscan::methods::lattice
