// SPDX-License-Identifier: Apache-2.0
#include "core/trial_layout.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"

namespace plotscan {
namespace {

double angle_of(const Eigen::Vector2d& axis) { return std::atan2(axis.y(), axis.x()); }

int highest(const std::vector<TrialPlace>& places, int TrialPlace::*number) {
  return places.empty() ? 0 : std::ranges::max(places, {}, number).*number;
}

}  // namespace

double TrialLayout::heading_rad() const { return wrap_heading(angle_of(column_axis)); }

double TrialLayout::skew_rad() const {
  return std::remainder(angle_of(row_axis) - angle_of(column_axis) - kPi / 2, kPi);
}

int TrialLayout::rows() const { return highest(places, &TrialPlace::row); }

int TrialLayout::columns() const { return highest(places, &TrialPlace::column); }

PlotBox TrialLayout::box(const TrialPlace& place) const {
  Eigen::Matrix2d axes;
  axes << row_axis, column_axis;
  return {.center = origin + axes * place.position_m,
          .width_m = width_m,
          .length_m = length_m,
          .heading_rad = heading_rad()};
}

}  // namespace plotscan
