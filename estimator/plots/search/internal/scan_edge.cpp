// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/scan_edge.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plotscan::plots {
namespace {

// The scanned area ends at a side beside which less than this was scanned, of what was in the plot,
// so far out and also farther: else the shadow of a canopy, or water, lies there.
constexpr double kLeastScanned = 0.25, kBesidePlot_m = 0.3, kFartherOut_m = 2;
constexpr double kScannedStep_m = 0.05;

using IsScanned = std::function<bool(const Eigen::Vector2d& place)>;

double scanned_share(const PlotBox& box, const IsScanned& is_scanned) {
  const auto steps = [](double side_m) {
    return std::max(1, static_cast<int>(std::lround(side_m / kScannedStep_m)));
  };
  const int along = steps(box.length_m), across = steps(box.width_m);
  int scanned = 0;
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < across; ++k) {
      const double length_m = box.length_m * ((i + 0.5) / along - 0.5);
      const double width_m = box.width_m * ((k + 0.5) / across - 0.5);
      scanned += is_scanned(box.center + length_m * box.length_axis() + width_m * box.width_axis());
    }
  }
  return static_cast<double>(scanned) / (along * across);
}

// The strips beside all four sides of a plot, from one distance to another.
std::array<PlotBox, 4> strips_beside(const PlotBox& plot, double from_m, double to_m) {
  const double middle_m = (from_m + to_m) / 2;
  std::array<PlotBox, 4> strips{plot, plot, plot, plot};
  for (std::size_t i = 0; i < strips.size(); ++i) {
    PlotBox& strip = strips[i];
    const double side = i % 2 == 0 ? 1 : -1;
    if (i < 2) {
      strip.center += side * (plot.length_m / 2 + middle_m) * plot.length_axis();
      strip.length_m = to_m - from_m;
    } else {
      strip.center += side * (plot.width_m / 2 + middle_m) * plot.width_axis();
      strip.width_m = to_m - from_m;
    }
  }
  return strips;
}

}  // namespace

bool is_cut_off(const PlotBox& plot, const IsScanned& is_scanned) {
  const double least = kLeastScanned * scanned_share(plot, is_scanned);
  const auto beside = strips_beside(plot, 0, kBesidePlot_m);
  const auto beyond = strips_beside(plot, kBesidePlot_m, kFartherOut_m);
  for (std::size_t side = 0; side < beside.size(); ++side)
    if (scanned_share(beside[side], is_scanned) < least &&
        scanned_share(beyond[side], is_scanned) < least)
      return true;
  return false;
}

}  // namespace plotscan::plots
