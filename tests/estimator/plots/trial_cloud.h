// SPDX-License-Identifier: Apache-2.0
#pragma once

// Clouds of trials whose plots are known, for the tests of the whole search.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/plot_box.h"
#include "core/random.h"
#include "plots/search/find_trials.h"

namespace plotscan::plots {

// Plots 4 m long on a lattice turned by 33 degrees, with the given gaps.
struct Trial {
  int rows = 3, columns = 6;
  double gap_m = 0.4, row_gap_m = 0.8, heading_rad = 33 * kDegrees;
  std::vector<double> offsets_m = {0, 0, 0};
  int missing = -1;  // number of the plot that is not there, row by row
  double width_m = 1.5;

  std::vector<PlotBox> boxes() const {
    std::vector<PlotBox> list;
    const PlotBox axes{.heading_rad = heading_rad};
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        if (row * columns + column == missing) continue;
        const double along = (row - 1) * (4 + row_gap_m);
        const double across =
            (column - 2.5) * (width_m + gap_m) + offsets_m[static_cast<std::size_t>(row)];
        list.push_back({.center = axes.length_axis() * along + axes.width_axis() * across,
                        .width_m = width_m,
                        .length_m = 4,
                        .heading_rad = heading_rad});
      }
    }
    return list;
  }
};

// Whether a plant stands at a place of a plot; `from_center` is along its length and its width.
using Sown = std::function<bool(const PlotBox& box, const Eigen::Vector2d& from_center)>;

inline bool everywhere(const PlotBox&, const Eigen::Vector2d&) { return true; }

// Returns spread evenly over a rectangle; of those in a box where plants stand, three of four are
// from its canopy.
inline std::vector<Eigen::Vector3f> cloud_over(const std::vector<PlotBox>& boxes,
                                               const Sown& sown = everywhere, double half_x_m = 12,
                                               double half_y_m = 12) {
  constexpr int kPoints = 400000;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < kPoints; ++i) {
    RandomStream random(7, random_purpose("test/point"), static_cast<std::uint64_t>(i));
    const Eigen::Vector2d place(random.uniform(-half_x_m, half_x_m),
                                random.uniform(-half_y_m, half_y_m));
    double height = 0.02 * random.normal();
    for (const PlotBox& box : boxes) {
      if (!box.contains(place) || !sown(box, box.box_from_world(place))) continue;
      if (random.uniform() < 0.75) height = random.uniform(0.3, 0.8);
    }
    points.emplace_back(place.cast<float>().x(), place.cast<float>().y(),
                        static_cast<float>(height));
  }
  return points;
}

// The plots of a field that is one trial.
inline PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m,
                            const Hints& hints, int threads, const GroundError& ground_error = {}) {
  std::vector<PlotField> trials = find_trials(points, noise_m, hints, threads, ground_error);
  EXPECT_EQ(trials.size(), 1u);
  return trials.front();
}

// Those plots were found, and no others.
inline void expect_those(const std::vector<PlotBox>& boxes, const PlotField& field,
                         double least_iou = 0.9) {
  EXPECT_EQ(field.why_none, "");
  ASSERT_EQ(field.plots.size(), boxes.size());
  for (const FoundPlot& plot : field.plots) {
    EXPECT_TRUE(std::ranges::any_of(boxes, [&](const PlotBox& box) {
      return intersection_over_union(box, plot.box) > least_iou;
    }));
  }
}

}  // namespace plotscan::plots
