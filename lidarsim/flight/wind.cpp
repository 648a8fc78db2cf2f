// SPDX-License-Identifier: Apache-2.0
#include "flight/wind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/coordinate_units.h"
#include "core/random.h"

namespace plotscan::flight {
namespace {

// One component of the gusts, in units of its standard deviation and its time T. The state is x1,
// white noise filtered by 1/(1 + Ts), and x2, x1 filtered by the same again. Their stationary
// covariance is [1/2 1/4; 1/4 1/4]: each step's noise restores what the step takes away from it.
class Component {
 public:
  // `along` selects the first-order filter, otherwise it is the second-order one.
  Component(double steps_per_time, bool along)
      : output_(along ? Eigen::Vector2d(std::numbers::sqrt2, 0)
                      : Eigen::Vector2d(std::numbers::sqrt3, 1 - std::numbers::sqrt3)) {
    const double step = 1 / steps_per_time;
    transition_ << 1, 0, step, 1;
    transition_ *= std::exp(-step);
    Eigen::Matrix2d steady;
    steady << 0.5, 0.25, 0.25, 0.25;
    start_ = root_of(steady);
    noise_ = root_of(steady - transition_ * steady * transition_.transpose());
  }

  void start(const std::pair<double, double>& normals) { state_ = start_ * vector(normals); }
  void step(const std::pair<double, double>& normals) {
    state_ = transition_ * state_ + noise_ * vector(normals);
  }
  double value() const { return output_.dot(state_); }

 private:
  static Eigen::Vector2d vector(const std::pair<double, double>& pair) {
    return {pair.first, pair.second};
  }

  // The lower triangular (Cholesky) root. For short steps the last entry is almost 0, and rounding
  // may make its square negative.
  static Eigen::Matrix2d root_of(const Eigen::Matrix2d& covariance) {
    const double a = std::sqrt(covariance(0, 0));
    const double b = covariance(1, 0) / a;
    Eigen::Matrix2d root;
    root << a, 0, b, std::sqrt(std::max(0.0, covariance(1, 1) - b * b));
    return root;
  }

  Eigen::Vector2d output_;
  Eigen::Matrix2d transition_;
  Eigen::Matrix2d start_;
  Eigen::Matrix2d noise_;
  Eigen::Vector2d state_ = Eigen::Vector2d::Zero();
};

// A rotation with the columns: along the wind, to its left, up.
Eigen::Matrix3d world_from_wind(double from_deg) {
  const double from_rad = radians(from_deg);
  const Eigen::Vector3d along(-std::sin(from_rad), -std::cos(from_rad), 0);
  Eigen::Matrix3d axes;
  axes << along, Eigen::Vector3d(-along.y(), along.x(), 0), Eigen::Vector3d::UnitZ();
  return axes;
}

}  // namespace

GustScales gust_scales(const WindOptions& options) {
  const double height_ft = std::clamp(options.height_m / kFoot_m, 10.0, 1000.0);
  const double shape = 0.177 + 0.000823 * height_ft;
  const double along_m_s = options.turbulence * options.mean_m_s;
  const double along_m = kFoot_m * height_ft / std::pow(shape, 1.2);
  return {.sigma_m_s = {along_m_s, along_m_s, along_m_s * std::pow(shape, 0.4)},
          .length_m = {along_m, along_m, kFoot_m * height_ft}};
}

Wind::Wind(const WindOptions& options, double duration_s) {
  const Eigen::Matrix3d axes = world_from_wind(options.from_deg);
  mean_m_s_ = options.mean_m_s * axes.col(0);
  const GustScales scales = gust_scales(options);
  if (scales.sigma_m_s.isZero(0)) return;
  std::array<Component, 3> components = {
      Component(scales.length_m[0] / options.mean_m_s / kStep_s, true),
      Component(scales.length_m[1] / options.mean_m_s / kStep_s, false),
      Component(scales.length_m[2] / options.mean_m_s / kStep_s, false)};
  const auto steps = static_cast<std::uint64_t>(std::ceil((duration_s + kLeadIn_s) / kStep_s)) + 1;
  gusts_m_s_.reserve(steps);
  for (std::uint64_t step = 0; step < steps; ++step) {
    RandomStream random(options.seed, random_purpose("wind/gust"), step);
    Eigen::Vector3d gust;
    for (int i = 0; i < 3; ++i) {
      step == 0 ? components[i].start(random.normal_pair())
                : components[i].step(random.normal_pair());
      gust[i] = scales.sigma_m_s[i] * components[i].value();
    }
    gusts_m_s_.push_back(axes * gust);
  }
}

Eigen::Vector3d Wind::velocity_m_s(double time_s) const {
  if (gusts_m_s_.empty()) return mean_m_s_;
  const double last = static_cast<double>(gusts_m_s_.size() - 1);
  const double step = std::clamp((time_s + kLeadIn_s) / kStep_s, 0.0, last);
  const auto before = static_cast<std::size_t>(std::min(step, last - 1));
  const double share = step - static_cast<double>(before);
  return mean_m_s_ + (1 - share) * gusts_m_s_[before] + share * gusts_m_s_[before + 1];
}

}  // namespace plotscan::flight
