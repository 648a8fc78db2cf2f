// SPDX-License-Identifier: Apache-2.0
#include "strata/trials_side_by_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "core/angle.h"
#include "description/load_description.h"
#include "planting/plot_layout.h"

namespace plotscan::strata {
namespace {

constexpr Bounds kApart_m = {1, 6};
constexpr Bounds kTurned_deg = {5, 40};
constexpr double kBeyond_m = 8;  // of the ground, beyond the outer plots

// A trial in a frame along the field's heading.
struct PlacedTrial {
  double heading_deg = 0;      // in that frame
  Eigen::AlignedBox2d extent;  // of its plots; moved to where the trial is to lie
  Eigen::Vector2d position_m;  // the description's position_m
};

// The plots of the trial that the overrides draw, of another heading and about the origin.
PlacedTrial turned_trial(const Overrides& overrides, const std::filesystem::path& field,
                         double heading_deg) {
  planting::PlotGridDescription grid =
      description::load_description(field, overrides).trials.front().plots;
  grid.heading_rad = heading_deg * kDegrees;
  grid.position_m.setZero();
  PlacedTrial trial{.heading_deg = heading_deg, .extent = {}, .position_m = {0, 0}};
  for (const farm::Plot& plot : planting::grid_plots(grid))
    for (const Eigen::Vector2d& corner : plot.box.corners()) trial.extent.extend(corner);
  return trial;
}

void move(PlacedTrial& trial, const Eigen::Vector2d& by_m) {
  trial.extent.translate(by_m);
  trial.position_m += by_m;
}

// One after the other along an axis of the frame, about the origin; across it, their middles or
// their edges in line.
void line_up(std::vector<PlacedTrial>& trials, RandomStream& random) {
  const Eigen::Index along = chance(random, 0.5) ? 0 : 1;
  const bool edges = chance(random, 0.33);
  const double apart_m = draw(random, kApart_m);
  Eigen::AlignedBox2d all;
  for (PlacedTrial& trial : trials) {
    Eigen::Vector2d by_m = -trial.extent.center();
    if (edges) by_m[1 - along] = -trial.extent.min()[1 - along];
    if (!all.isEmpty()) by_m[along] = all.max()[along] + apart_m - trial.extent.min()[along];
    move(trial, by_m);
    all.extend(trial.extent);
  }
  const Eigen::Vector2d middle = all.center();
  for (PlacedTrial& trial : trials) move(trial, -middle);
}

double side_around(const std::vector<PlacedTrial>& trials) {
  double reach_m = 0;  // in every heading of the frame
  for (const PlacedTrial& trial : trials) {
    const Eigen::Vector2d farthest =
        trial.extent.min().cwiseAbs().cwiseMax(trial.extent.max().cwiseAbs());
    reach_m = std::max(reach_m, farthest.norm());
  }
  return 2 * std::ceil(reach_m + kBeyond_m);
}

}  // namespace

Overrides side_by_side(const std::vector<Overrides>& trials, const std::filesystem::path& field,
                       RandomStream& random) {
  const bool turned = chance(random, 0.25);
  std::vector<PlacedTrial> placed;
  for (const Overrides& trial : trials) {
    double heading_deg = pick(random, std::array{0.0, 90.0});
    if (turned && !placed.empty()) heading_deg += draw(random, kTurned_deg);
    placed.push_back(turned_trial(trial, field, heading_deg));
  }
  line_up(placed, random);
  const double heading_deg = random.uniform(0, 180);
  const Eigen::Rotation2Dd world_from_frame(heading_deg * kDegrees);
  Overrides set = {"terrain.side_m=" + text(side_around(placed))};
  std::string empty_trials;
  for (std::size_t i = 0; i < trials.size(); ++i) empty_trials += i > 0 ? ", {}" : "{}";
  set.push_back("trials=[" + empty_trials + "]");
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::string key = "trials." + std::to_string(i) + ".";
    for (const std::string& assignment : trials[i])
      if (!assignment.starts_with("terrain.")) set.push_back(key + assignment);
    const Eigen::Vector2d position_m = world_from_frame * placed[i].position_m;
    set.push_back(key + "plots.heading_deg=" + text(placed[i].heading_deg + heading_deg));
    set.push_back(key + "plots.position_m=[" + text(position_m.x()) + ", " + text(position_m.y()) +
                  "]");
  }
  return set;
}

}  // namespace plotscan::strata
