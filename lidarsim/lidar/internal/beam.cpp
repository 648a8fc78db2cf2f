// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/beam.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/angle.h"
#include "core/error.h"

namespace plotscan::lidar {
namespace {

// The golden ratio's fractional part, and the same times 2^64: its multiples, modulo 1, fill the
// circle with the least discrepancy.
constexpr double kGolden = 0.6180339887498949;
constexpr std::uint64_t kGolden64 = 0x9E3779B97F4A7C15;

constexpr std::size_t kLanes = 8;

// The mean square distance of standard normal points in a ring. The square distance is -2 ln(v),
// where v, in [low, high] for the ring, is the probability that a point lies further out.
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
    const double angle = kPi * std::fmod(i * kGolden, 1.0);
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
    : count_(static_cast<std::size_t>(count)),
      pattern_((count_ + kLanes - 1) / kLanes),
      along_rad_(static_cast<float>(beam.along_rad / 4)),
      across_rad_(static_cast<float>(beam.across_rad / 4)) {
  const std::vector<Eigen::Vector2d> pattern = normal_pattern(count);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto lane = static_cast<Eigen::Index>(i % kLanes);
    pattern_[i / kLanes].x[lane] = static_cast<float>(pattern[i].x());
    pattern_[i / kLanes].y[lane] = static_cast<float>(pattern[i].y());
  }
}

void SubRays::spread(const Ray& axis, const Eigen::Vector3f& spin_axis, std::uint64_t shot,
                     RayArrays& rays, std::size_t first) const {
  constexpr float kParallel = 1e-4f;  // a shot along the spin axis, where the spin has no direction
  Eigen::Vector3f along = axis.direction.cross(spin_axis);
  along = along.norm() > kParallel ? along.normalized() : axis.direction.unitOrthogonal();
  const Eigen::Vector3f across = axis.direction.cross(along);
  // The pattern is its own reflection: half a turn maps it onto itself.
  const double turn = kPi * static_cast<double>(shot * kGolden64) * 0x1p-64;
  const auto cosine = static_cast<float>(std::cos(turn));
  const auto sine = static_cast<float>(std::sin(turn));
  const auto begin = static_cast<std::ptrdiff_t>(first);
  std::fill_n(rays.time_s.begin() + begin, count_, axis.time_s);
  for (std::size_t c = 0; c < 3; ++c)
    std::fill_n(rays.origin_m[c].begin() + begin, count_,
                axis.origin_m[static_cast<Eigen::Index>(c)]);
  for (std::size_t i = 0; i < pattern_.size(); ++i) {
    const Lanes x = along_rad_ * (cosine * pattern_[i].x - sine * pattern_[i].y);
    const Lanes y = across_rad_ * (sine * pattern_[i].x + cosine * pattern_[i].y);
    std::array<Lanes, 3> aside;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      aside[c] = axis.direction[k] + x * along[k] + y * across[k];
    }
    const Lanes length = (aside[0].square() + (aside[1].square() + aside[2].square())).sqrt();
    const std::size_t done = i * kLanes;
    for (std::size_t c = 0; c < 3; ++c) {
      const Lanes direction = aside[c] / length;
      std::copy_n(direction.data(), std::min(kLanes, count_ - done),
                  rays.direction[c].begin() + begin + static_cast<std::ptrdiff_t>(done));
    }
  }
}

}  // namespace plotscan::lidar
