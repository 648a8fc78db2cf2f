// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/work_estimate.h"

#include <algorithm>
#include <cmath>

#include "cloud/field_density.h"
#include "ground/columns.h"

namespace plotscan::methods::lattice {
namespace {

// Seconds of one core: for a point and a node of the ground; plots of a hectare, which grow faster.
constexpr double kSecondsOfPoint = 0.3e-6;
constexpr double kSecondsOfNode = 7e-6;
constexpr double kSecondsOfPlots_ha = 4;
constexpr double kPlotsPower = 1.7;
// Share of each further thread's time that is gained.
constexpr double kThreadGain = 0.5;
constexpr int kMostGain = 8;
// Bytes: of the program, of a point while it is read, and of the first of them while they are
// merged (tile_store.h); of the ground's points and nodes; of the search's points and area.
constexpr double kProgram = 60e6;
constexpr double kReadPoint = 16, kMergedPoint = 20, kMostMerged = 16.8e6;
constexpr double kGroundPoint = 14, kGroundNode = 390;
constexpr double kSearchPoint = 24, kSearch_ha = 190e6;
// Above this area the search's cells are twice as wide, and so on
// (plots/canopy/canopy_raster.cpp).
constexpr double kFineSearch_ha = 6.25;

// The area of finest cells, hectares, whose search takes equal work; 0 where no plots are searched.
double searched_ha(const FieldSize& field) {
  if (field.density_m2 < cloud::kLeastSearched_m2) return 0;
  double hectares = field.rectangle_m2 / 1e4;
  while (hectares > kFineSearch_ha) hectares /= 4;
  return hectares;
}

}  // namespace

WorkEstimate estimate_work(const FieldSize& field, int threads) {
  const auto points = static_cast<double>(field.points);
  const double cell_m = ground::cell_for(std::max(field.density_m2, 1e-9));
  const double nodes = field.rectangle_m2 / (cell_m * cell_m);
  const double hectares = searched_ha(field);
  const double seconds = kSecondsOfPoint * points + kSecondsOfNode * nodes +
                         kSecondsOfPlots_ha * std::pow(hectares, kPlotsPower);
  const double bytes = std::max({kReadPoint * points + kMergedPoint * std::min(points, kMostMerged),
                                 kGroundPoint * points + kGroundNode * nodes,
                                 hectares > 0 ? kSearchPoint * points + kSearch_ha * hectares : 0});
  const double gain = 1 + kThreadGain * (std::clamp(threads, 1, kMostGain) - 1);
  return {.seconds = seconds / gain, .gigabytes = (kProgram + bytes) / 1e9};
}

}  // namespace plotscan::methods::lattice
