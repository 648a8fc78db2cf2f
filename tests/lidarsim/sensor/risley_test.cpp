// SPDX-License-Identifier: Apache-2.0
#include "sensor/risley.h"

#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "sensor/shots.h"

namespace plotscan::sensor {
namespace {

// A ray refracted at a surface by angles: it is turned, in the plane of incidence, by the
// difference of the angles before and behind the surface.
Eigen::Vector3d refracted(const Eigen::Vector3d& ray, const Eigen::Vector3d& normal,
                          double index_before, double index_behind) {
  const Eigen::Vector3d axis = normal.cross(ray);
  if (axis.norm() < 1e-14) return ray;
  const double before = std::atan2(axis.norm(), normal.dot(ray));
  const double behind = std::asin(index_before / index_behind * std::sin(before));
  return Eigen::AngleAxisd(behind - before, axis.normalized()) * ray;
}

// The Mid-40's beam through four surfaces (Brazeal et al. 2021, section 3), each prism turned as a
// body about x.
Eigen::Vector3d plain_direction(double time_s) {
  constexpr double kWedge = radians(18);
  constexpr double kGlass = 1.51;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::AngleAxisd first(2 * kPi * std::fmod(7294.0 / 60 * time_s, 1), x);
  const Eigen::AngleAxisd second(2 * kPi * std::fmod(-4664.0 / 60 * time_s, 1), x);
  // Thick towards y at time 0: the slanted side leans towards -y, or towards +y where light enters.
  const Eigen::Vector3d leaving(std::cos(kWedge), -std::sin(kWedge), 0);
  const Eigen::Vector3d entering(std::cos(kWedge), std::sin(kWedge), 0);
  Eigen::Vector3d ray = refracted(x, x, 1, kGlass);
  ray = refracted(ray, first * leaving, kGlass, 1);
  ray = refracted(ray, second * entering, 1, kGlass);
  return refracted(ray, x, kGlass, 1);
}

scan::Trajectory hovering(double duration_s) {
  return scan::Trajectory({{.time_s = 0}, {.time_s = duration_s}});
}

ShotPlan mid40(double duration_s) {
  return {load_sensor("livox_mid40"), 0, Eigen::Isometry3d::Identity(), hovering(duration_s)};
}

// Calls visit(time_s, direction) for every shot of the plan.
template <class Visit>
void for_every_shot(const ShotPlan& plan, Visit&& visit) {
  SequenceShots shots;
  for (std::uint64_t sequence = 0; sequence < plan.sequences(); ++sequence) {
    plan.fire(sequence, shots);
    for (std::size_t k = 0; k < plan.lasers(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      visit(plan.time_s(sequence, k),
            Eigen::Vector3d(shots.direction[0][i], shots.direction[1][i], shots.direction[2][i]));
    }
  }
}

TEST(Risley, EveryShotIsWhereSnellsLawSendsIt) {
  int shot = 0;
  for_every_shot(mid40(0.5), [&](double time_s, const Eigen::Vector3d& direction) {
    ASSERT_NEAR(time_s, 1e-5 * shot, 1e-12);
    ASSERT_LT((direction - plain_direction(1e-5 * shot)).norm(), 1e-11) << "shot " << shot;
    ++shot;
  });
  EXPECT_NEAR(shot, 50'000, 32);
}

TEST(Risley, DoesNotDriftInAnHour) {
  const ShotPlan plan = mid40(3600);
  SequenceShots shots;
  for (const std::uint64_t sequence : {std::uint64_t{0}, plan.sequences() - 1}) {
    plan.fire(sequence, shots);
    for (std::size_t k = 0; k < plan.lasers(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Eigen::Vector3d expected = plain_direction(plan.time_s(sequence, k));
      EXPECT_NEAR(shots.direction[1][i], expected.y(), 1e-8);
      EXPECT_NEAR(shots.direction[2][i], expected.z(), 1e-8);
    }
  }
}

// Livox states a circular field of view of 38.4 degrees.
TEST(Risley, FieldOfViewIsTheDataSheets) {
  double greatest = 0;
  double least = kPi;
  for_every_shot(mid40(10), [&](double, const Eigen::Vector3d& direction) {
    const double off_axis = std::atan2(direction.tail<2>().norm(), direction.x());
    greatest = std::max(greatest, off_axis);
    least = std::min(least, off_axis);
  });
  EXPECT_NEAR(degrees(2 * greatest), 38.4, 0.05);
  EXPECT_LT(degrees(least), 0.1);
  const auto deflections = deflections_rad(*load_sensor("livox_mid40").wedges);
  EXPECT_NEAR(deflections[0], greatest, 1e-6);
  EXPECT_NEAR(deflections[1], 0, 1e-12);
}

// The share of cells of 5 mrad in the field of view that hold a shot: so Livox counts coverage
// (github.com/Livox-SDK/Livox-SDK/issues/57).
double coverage(double duration_s) {
  constexpr double kCell_rad = 5e-3;
  constexpr int kHalf = 80;
  const double radius = radians(19.2);
  std::set<std::pair<int, int>> hit;
  for_every_shot(mid40(duration_s), [&](double, const Eigen::Vector3d& direction) {
    hit.emplace(std::floor(std::atan2(direction.y(), direction.x()) / kCell_rad),
                std::floor(std::asin(direction.z()) / kCell_rad));
  });
  int cells = 0;
  int covered = 0;
  for (int i = -kHalf; i < kHalf; ++i) {
    for (int j = -kHalf; j < kHalf; ++j) {
      if (std::hypot(i + 0.5, j + 0.5) * kCell_rad >= radius) continue;
      ++cells;
      covered += static_cast<int>(hit.contains({i, j}));
    }
  }
  return static_cast<double>(covered) / cells;
}

// A user of the sensor reports nearly all of the field of view in a second (Livox-SDK, issue 57). A
// pattern that repeated itself would stop growing.
TEST(Risley, CoverageGrowsWithTime) {
  EXPECT_NEAR(coverage(0.1), 0.20, 0.02);
  EXPECT_GT(coverage(0.5), 0.6);
  EXPECT_GT(coverage(1), 0.9);
  EXPECT_GT(coverage(2), 0.995);
}

TEST(Risley, UnlikePrismsLeaveAHoleInTheMiddle) {
  const Wedge strong{.slant_rad = 0.3, .refractive_index = 1.5};
  const Wedge weak{.slant_rad = 0.1, .refractive_index = 1.7};
  const auto deflections = deflections_rad({strong, weak});
  // Thin prisms: (n - 1) * wedge, 0.15 and 0.07, less their own third-order terms.
  EXPECT_NEAR(deflections[0], 0.15 + 0.07, 0.02);
  EXPECT_NEAR(deflections[1], 0.15 - 0.07, 0.02);
}

}  // namespace
}  // namespace plotscan::sensor
