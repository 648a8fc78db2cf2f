// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

// Chosen on 51 farms of one word, as docs/plot-finding-tests.md says.
constexpr double kOfSpread =
    0.65;  // of the leaves' spread over an edge, in which the sown one lies
// Errors of neighbouring centres are correlated, so a fit to them has this many times the error of
// a fit to independent ones.
constexpr double kAlikeErrors = 2;
constexpr double kLeastCentre_m = 0.005;

// Standard error of a fitted value: the residuals' rms times the square root of the mean leverage
// (parameters per plot).
double centre_error_m(const Side& side, std::size_t plots) {
  const double leverage = std::min(1.0, side.parameters / static_cast<double>(plots));
  return std::max(kLeastCentre_m, kAlikeErrors * side.rms_m * std::sqrt(leverage));
}

}  // namespace

PlotBoxError box_error(const Lattice& lattice, const Hints& hints) {
  const bool along_r = lattice.r.size_m >= lattice.c.size_m;
  const Side &length = along_r ? lattice.r : lattice.c, &width = along_r ? lattice.c : lattice.r;
  const std::size_t plots = lattice.places.size();
  // A plot's own long edges, blurred by leaves, tell their direction where few others do.
  const double of_edges_rad = width.blur_m / std::max(length.size_m, width.blur_m);
  return {.along_m = centre_error_m(length, plots),
          .across_m = centre_error_m(width, plots),
          .width_m = hints.width_m ? 0 : kOfSpread * width.blur_m,
          .length_m = hints.length_m ? 0 : kOfSpread * length.blur_m,
          .heading_rad = std::min(kAlikeErrors * lattice.turn_error_rad, of_edges_rad)};
}

}  // namespace plotscan::plots
