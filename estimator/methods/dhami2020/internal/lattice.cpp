// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "core/list_of.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Centers = std::span<const Eigen::Vector2d>;

constexpr double kTolerance = 0.2;       // of the plot's side: a centre that agrees
constexpr double kLeastStep = 0.9;       // of the plot's side: plots do not overlap
constexpr double kNeighbourCone = 0.2;   // rad about an axis, within which a neighbour is sought
constexpr std::size_t kNeighbours = 2;   // nearest neighbours tried along each axis
constexpr std::size_t kMostSeeds = 100;  // centres from which a lattice is grown
constexpr double kLeastSine = 0.8;       // of the angle between the steps
constexpr int kSettlingRounds = 5;       // refits over all centres

// A centre and the lattice point that it agrees with.
struct Member {
  std::size_t center = 0;
  Eigen::Vector2i index = Eigen::Vector2i::Zero();
};

// The centres within tolerance of a lattice point at most `reach` steps from the origin, the
// nearest one for each lattice point.
std::vector<Member> members_of(const Lattice& lattice, Centers centers, const PlotBox& plot,
                               int reach) {
  std::map<std::pair<int, int>, std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Eigen::Vector2i index = lattice.nearest(centers[i]);
    if (index.cwiseAbs().maxCoeff() > reach) continue;
    const Eigen::Vector2d offset = centers[i] - lattice.point(index);
    if (std::abs(offset.dot(plot.length_axis())) > kTolerance * plot.length_m ||
        std::abs(offset.dot(plot.width_axis())) > kTolerance * plot.width_m) {
      continue;
    }
    const std::pair candidate(offset.norm(), i);
    const auto [place, is_new] = nearest.emplace(std::pair(index.x(), index.y()), candidate);
    if (!is_new) place->second = std::min(place->second, candidate);
  }
  return list_of(nearest, [](const auto& entry) {
    const auto& [index, candidate] = entry;
    return Member{candidate.second, {index.first, index.second}};
  });
}

// Moves origin and steps to least squares over the members.
void refit(Lattice& lattice, Centers centers, const std::vector<Member>& members) {
  // What the members do not determine (a step in a direction in which they all have one index)
  // stays as it is: a trace of ridge on the change.
  Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const Member& member : members) {
    const Eigen::Vector3d row(1, member.index.x(), member.index.y());
    normal += row * row.transpose();
    right += row * (centers[member.center] - lattice.point(member.index)).transpose();
  }
  const Eigen::Matrix<double, 3, 2> change = normal.ldlt().solve(right);
  lattice.origin += change.row(0).transpose();
  lattice.steps += change.bottomRows<2>().transpose();
}

bool is_sound(const Lattice& lattice, const PlotBox& plot) {
  const double row_step_m = lattice.steps.col(0).norm();
  const double column_step_m = lattice.steps.col(1).norm();
  return row_step_m >= kLeastStep * plot.length_m && column_step_m >= kLeastStep * plot.width_m &&
         std::abs(lattice.steps.determinant()) >= kLeastSine * row_step_m * column_step_m;
}

bool has_many(const std::vector<Member>& members, int axis) {
  return std::ranges::any_of(members, [&](const Member& member) {
    return member.index[axis] != members.front().index[axis];
  });
}

// Refits the seed to ever more of its surroundings, so that the error of its short steps does not
// grow with the distance; empty when it turns into something that is no grid of plots.
std::optional<Lattice> grow(Lattice lattice, Centers centers, const PlotBox& plot) {
  int farthest = 1;
  for (const Eigen::Vector2d& center : centers) {
    farthest = std::max(farthest, lattice.nearest(center).cwiseAbs().maxCoeff());
  }
  for (int reach = 1; reach < farthest; reach *= 2) {
    refit(lattice, centers, members_of(lattice, centers, plot, reach));
    if (!is_sound(lattice, plot)) return std::nullopt;
  }
  for (int round = 0; round < kSettlingRounds; ++round) {
    refit(lattice, centers, members_of(lattice, centers, plot, 2 * farthest));
    if (!is_sound(lattice, plot)) return std::nullopt;
  }
  const std::vector<Member> members = members_of(lattice, centers, plot, 2 * farthest);
  if (members.empty()) return std::nullopt;
  lattice.agreeing = members.size();
  lattice.many_rows = has_many(members, 0);
  lattice.many_columns = has_many(members, 1);
  double squares_m2 = 0;
  for (const Member& member : members) {
    squares_m2 += (centers[member.center] - lattice.point(member.index)).squaredNorm();
  }
  lattice.rms_m = std::sqrt(squares_m2 / static_cast<double>(members.size()));
  return lattice;
}

// The steps from a centre to its nearest neighbours in a cone about an axis, pointing along it;
// twice the plot's side where there is no neighbour.
std::vector<Eigen::Vector2d> steps_along(Centers centers, const Eigen::Vector2d& from,
                                         const Eigen::Vector2d& axis, double side_m) {
  std::vector<std::pair<double, Eigen::Vector2d>> found;
  for (const Eigen::Vector2d& center : centers) {
    const Eigen::Vector2d step = center - from;
    const double along_m = step.dot(axis);
    const double distance_m = step.norm();
    if (distance_m < kLeastStep * side_m) continue;
    if (std::abs(along_m) < std::cos(kNeighbourCone) * distance_m) continue;
    found.emplace_back(distance_m, along_m < 0 ? Eigen::Vector2d(-step) : step);
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, Eigen::Vector2d>::first);
  std::vector<Eigen::Vector2d> steps;
  for (std::size_t i = 0; i < std::min(found.size(), kNeighbours); ++i) {
    steps.push_back(found[i].second);
  }
  if (steps.empty()) steps.emplace_back(2 * side_m * axis);
  return steps;
}

// How many centres agree beyond those that agree by chance when the centres are strewn at random.
double merit(const Lattice& lattice, std::size_t centers, const PlotBox& plot) {
  const double agreeing_area_m2 = 4 * kTolerance * kTolerance * plot.area_m2();
  const double chance = agreeing_area_m2 / std::abs(lattice.steps.determinant());
  return static_cast<double>(lattice.agreeing) - chance * static_cast<double>(centers);
}

}  // namespace

Eigen::Vector2i Lattice::nearest(const Eigen::Vector2d& position) const {
  constexpr double kFarthest = 1e6;
  const Eigen::Array2d index = (steps.inverse() * (position - origin)).array().round();
  return index.max(-kFarthest).min(kFarthest).cast<int>().matrix();
}

Lattice refitted(Lattice lattice, Centers centers, const PlotBox& plot, int reach) {
  refit(lattice, centers, members_of(lattice, centers, plot, reach));
  return lattice;
}

std::optional<Lattice> fit_lattice(Centers centers, const PlotBox& plot) {
  std::optional<Lattice> best;
  const std::size_t stride = std::max<std::size_t>(1, centers.size() / kMostSeeds);
  for (std::size_t i = 0; i < centers.size(); i += stride) {
    const Eigen::Vector2d& seed = centers[i];
    for (const auto& row_step : steps_along(centers, seed, plot.length_axis(), plot.length_m)) {
      for (const auto& column_step : steps_along(centers, seed, plot.width_axis(), plot.width_m)) {
        Lattice lattice{.origin = seed};
        lattice.steps << row_step, column_step;
        const std::optional<Lattice> grown = grow(lattice, centers, plot);
        if (!grown) continue;
        const double gain = merit(*grown, centers.size(), plot) -
                            (best ? merit(*best, centers.size(), plot) : -1e300);
        if (gain > 0 || (gain == 0 && grown->rms_m < best->rms_m)) best = grown;
      }
    }
  }
  return best;
}

}  // namespace plotscan::methods::dhami2020
