// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "cloud/cloud_map.h"
#include "core/plot_box.h"
#include "core/random.h"

namespace plotscan::testing {

// A field made by the test alone: points on a plane, canopies over it, everything known.
struct SyntheticFarm {
  int rows = 3;      // along the plots' length
  int columns = 10;  // along the plots' width
  double width_m = 1.5, length_m = 4.0;
  double column_step_m = 2.5, row_step_m = 5.5;
  double heading_rad = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // of the whole field
  double spacing_m = 0.05;                           // between points
  double margin_m = 2;                               // of bare ground around the plots

  double ground_z(const Eigen::Vector2d& at) const { return slope.dot(at); }
  Eigen::Vector3d normal() const { return Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized(); }
  // The canopy's height over the plane, different in each plot.
  double height_m(int row, int column) const { return 0.6 + 0.02 * column + 0.05 * row; }

  Eigen::Vector2d along() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
  Eigen::Vector2d across() const { return {-std::sin(heading_rad), std::cos(heading_rad)}; }

  // Before the offset.
  PlotBox box(int row, int column) const {
    return {.center = along() * (row_step_m * (row - (rows - 1) / 2.0)) +
                      across() * (column_step_m * (column - (columns - 1) / 2.0)),
            .width_m = width_m,
            .length_m = length_m,
            .heading_rad = heading_rad};
  }
  std::vector<PlotBox> boxes() const {
    std::vector<PlotBox> all;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        all.push_back(box(row, column));
        all.back().center += offset.head<2>();
      }
    }
    return all;
  }
  std::vector<double> heights() const {
    std::vector<double> all;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) all.push_back(height_m(row, column));
    }
    return all;
  }

  std::vector<Eigen::Vector3d> points() const {
    std::vector<Eigen::Vector3d> all;
    add_ground(all);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) add_canopy(row, column, all);
    }
    for (Eigen::Vector3d& point : all) point += offset;
    return all;
  }

  cloud::Area area() const {
    const double half = (rows * row_step_m + columns * column_step_m) / 2 + margin_m;
    return {offset.x() - half, offset.y() - half, offset.x() + half, offset.y() + half};
  }
  cloud::CloudMap map() const {
    cloud::CloudMap result(area());
    result.add(points());
    return result;
  }

 private:
  static void for_grid(double length_m, double width_m, double spacing_m,
                       const std::function<void(double, double)>& visit) {
    const int steps_u = static_cast<int>(std::lround(length_m / spacing_m));
    const int steps_v = static_cast<int>(std::lround(width_m / spacing_m));
    for (int i = 0; i <= steps_u; ++i) {
      for (int j = 0; j <= steps_v; ++j) {
        visit(length_m * (i / static_cast<double>(steps_u) - 0.5),
              width_m * (j / static_cast<double>(steps_v) - 0.5));
      }
    }
  }

  void add_ground(std::vector<Eigen::Vector3d>& all) const {
    for_grid(rows * row_step_m + 2 * margin_m, columns * column_step_m + 2 * margin_m, spacing_m,
             [&](double u, double v) {
               const Eigen::Vector2d at = along() * u + across() * v;
               all.emplace_back(at.x(), at.y(), ground_z(at));
             });
  }
  // Points spread in height between a third of the canopy's height and the whole; every tenth at
  // its very top.
  void add_canopy(int row, int column, std::vector<Eigen::Vector3d>& all) const {
    const PlotBox plot = box(row, column);
    RandomStream random(7, random_purpose("test/canopy"), 1000 * row + column);
    int count = 0;
    for_grid(plot.length_m, plot.width_m, spacing_m, [&](double u, double v) {
      const Eigen::Vector2d at = plot.center + along() * u + across() * v;
      const double share = count++ % 10 == 0 ? 1 : random.uniform(0.33, 1);
      all.push_back(Eigen::Vector3d(at.x(), at.y(), ground_z(at)) +
                    share * height_m(row, column) * normal());
    });
  }
};

}  // namespace plotscan::testing
