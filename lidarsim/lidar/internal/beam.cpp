// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/beam.h"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/error.h"

namespace plotscan::lidar {
namespace {

// The golden ratio's fractional part, and as a fraction of 2^64: its multiples fill the circle with
// the least discrepancy.
constexpr double kGolden = 0.6180339887498949;
constexpr std::uint64_t kGolden64 = 0x9E3779B97F4A7C15;

// The mean of a standard normal point's square distance, -2 ln(v), over those with v, the
// probability of one further out, in [low, high].
double mean_square_distance(double low, double high) {
  const auto integral = [](double v) { return v == 0 ? 0.0 : v * (1 - std::log(v)); };
  return 2 * (integral(high) - integral(low)) / (high - low);
}

}  // namespace

std::vector<Eigen::Vector2d> normal_pattern(int count) {
  check(count >= 1 && count <= kMaxSubRays, "a beam has 1 to 1024 sub-rays");
  if (count == 1) return {Eigen::Vector2d::Zero()};
  if (count <= 3) {
    const Eigen::Vector2d point(std::sqrt(count), 0);
    return count == 2 ? std::vector{point, Eigen::Vector2d(-point)}
                      : std::vector{point, Eigen::Vector2d(-point), Eigen::Vector2d(0, 0)};
  }
  const int pairs = count / 2;
  const double outside = count % 2 == 0 ? 1.0 : 1 - 1.0 / count;  // of what the origin stands for
  std::vector<Eigen::Vector2d> points;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int i = 0; i < pairs; ++i) {
    const double square =
        mean_square_distance(outside * (pairs - i - 1) / pairs, outside * (pairs - i) / pairs);
    const double angle = std::numbers::pi * std::fmod(i * kGolden, 1.0);
    points.push_back(std::sqrt(square) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    points.push_back(-points.back());
    covariance += 2.0 / count * points.back() * points.back().transpose();
  }
  const Eigen::Matrix2d to_unit =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).operatorInverseSqrt();
  for (Eigen::Vector2d& point : points) point = to_unit * point;
  if (count % 2 == 1) points.push_back(Eigen::Vector2d::Zero());
  return points;
}

SubRays::SubRays(const sensor::Beam& beam, int count)
    : along_rad_(static_cast<float>(beam.along_rad / 4)),
      across_rad_(static_cast<float>(beam.across_rad / 4)) {
  for (const Eigen::Vector2d& point : normal_pattern(count))
    pattern_.push_back(point.cast<float>());
}

void SubRays::append(const Ray& axis, const Eigen::Vector3f& spin_axis, std::uint64_t shot,
                     std::vector<Ray>& rays) const {
  constexpr float kParallel = 1e-4f;  // a shot along the spin axis: no direction is the spin's
  Eigen::Vector3f along = axis.direction.cross(spin_axis);
  along = along.norm() > kParallel ? along.normalized() : axis.direction.unitOrthogonal();
  const Eigen::Vector3f across = axis.direction.cross(along);
  // Half a turn is a whole period of a pattern that is its own reflection.
  const double turn = std::numbers::pi * static_cast<double>(shot * kGolden64) * 0x1p-64;
  const auto cosine = static_cast<float>(std::cos(turn));
  const auto sine = static_cast<float>(std::sin(turn));
  for (const Eigen::Vector2f& point : pattern_) {
    const float x = along_rad_ * (cosine * point.x() - sine * point.y());
    const float y = across_rad_ * (sine * point.x() + cosine * point.y());
    rays.push_back({.origin_m = axis.origin_m,
                    .direction = (axis.direction + x * along + y * across).normalized(),
                    .time_s = axis.time_s});
  }
}

}  // namespace plotscan::lidar
