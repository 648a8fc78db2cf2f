// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/centers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "plots/lattice/depth_profile.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr double kMostShift_m = 0.3, kShiftStep_m = 0.02;
constexpr double kEdge_m = 0.12;        // width of the edges' filter
constexpr double kBeyond_m = 0.6;       // of a plot's edge that takes part
constexpr double kMostInside_m = 1.02;  // half a spacing on either side: maize, rows 40 in apart
constexpr double kLeastOfSize = 0.3;    // chosen

struct Neighbour {
  double at_m = 0;  // from the plot's centre
  double depth = 0;
};

// The places next to it before and after along the axis, where they overlap aside of it.
std::vector<Neighbour> plots_beside(const Lattice& lattice, const std::vector<double>& depths,
                                    std::size_t of) {
  const Place& self = lattice.places[of];
  const double side_m = lattice.c.size_m, size_m = lattice.r.size_m;
  std::vector<Neighbour> near;
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    const Place& other = lattice.places[i];
    const double aside_m = std::abs(other.c_m - self.c_m);
    const double along_m = other.r_m - self.r_m;
    if (i == of || aside_m >= side_m || std::abs(along_m) > 1.8 * size_m + 1) continue;
    if (std::abs(along_m) < 0.5 * size_m) continue;
    // It covers only a part of this plot's side where rows are offset.
    near.push_back({along_m, depths[i] * std::min(1.0, (side_m - aside_m) / (0.9 * side_m))});
  }
  return near;
}

// Weight of a cell that lies `inside_m` within the edge: derivative of a normal kernel.
double edge_weight(double inside_m) {
  const double x = inside_m / kEdge_m;
  return std::abs(x) < 4 ? x * std::exp(-0.5 * x * x) : 0;
}

// A plot's cover after the neighbours' part is subtracted.
struct OwnCover {
  std::vector<double> x_m, cover;

  // Heights of the edges of a box of size_m about at_m: before and after it.
  Eigen::Array2d edges(double at_m, double size_m) const {
    Eigen::Array2d heights(0, 0);
    for (std::size_t i = 0; i < cover.size(); ++i) {
      const double off_m = x_m[i] - at_m;
      heights[off_m < 0 ? 0 : 1] += cover[i] * edge_weight(size_m / 2 - std::abs(off_m));
    }
    return heights;
  }
};

OwnCover own_cover(const DepthProfile& profile, const std::vector<Neighbour>& near,
                   const BlurredBox& box) {
  OwnCover own{.x_m = profile.x_m, .cover = {}};
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    double depth = profile.depth[i];
    for (const Neighbour& other : near) depth -= other.depth * box(profile.x_m[i] - other.at_m);
    own.cover.push_back(1 - std::exp(-std::max(0.0, depth)));
  }
  return own;
}

// The size whose edges are steepest over all plots: leaves lean out over the sown area, or the
// outer rows end half a spacing within it, and a box of another size would move towards the blunter
// one of a plot's edges. Both count: one edge alone is another plot's.
double steepest_size(const std::vector<OwnCover>& covers, double size_m) {
  double best = 0, best_size_m = size_m;
  for (const double wider : steps_between(-kMostInside_m, 0.4, 0.02)) {
    if (size_m + wider < kLeastOfSize * size_m) continue;
    Eigen::Array2d heights(0, 0);
    for (const OwnCover& own : covers) heights += own.edges(0, size_m + wider);
    if (heights.minCoeff() <= best) continue;
    best = heights.minCoeff();
    best_size_m = size_m + wider;
  }
  return best_size_m;
}

// Where the two edges are steepest together.
std::optional<double> shift_of(const OwnCover& own, double size_m) {
  const int steps = static_cast<int>(std::lround(kMostShift_m / kShiftStep_m));
  std::vector<double> gains;
  for (int step = -steps; step <= steps; ++step) {
    gains.push_back(own.edges(step * kShiftStep_m, size_m).sum());
  }
  const auto best = static_cast<std::size_t>(std::ranges::max_element(gains) - gains.begin());
  if (best == 0 || best + 1 == gains.size()) return std::nullopt;
  const double part = parabola_top(gains[best - 1], gains[best], gains[best + 1]);
  return (static_cast<double>(best) - steps + part) * kShiftStep_m;
}

}  // namespace

std::vector<std::optional<double>> measured_shifts(const Lattice& lattice) {
  const double size_m = lattice.r.size_m;
  const BlurredBox box(size_m, lattice.r.blur_m);
  std::vector<DepthProfile> profiles;
  std::vector<double> depths;
  for (const Place& place : lattice.places) {
    profiles.push_back(profile_of(lattice, place, size_m / 2 + kBeyond_m));
    depths.push_back(plateau_depth(profiles.back(), size_m));
  }
  std::vector<OwnCover> covers;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    covers.push_back(own_cover(profiles[i], plots_beside(lattice, depths, i), box));
  }
  const double steep_m = steepest_size(covers, size_m);
  std::vector<std::optional<double>> shifts;
  shifts.reserve(covers.size());
  for (const OwnCover& own : covers) shifts.push_back(shift_of(own, steep_m));
  return shifts;
}

}  // namespace plotscan::plots
