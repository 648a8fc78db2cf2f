// SPDX-License-Identifier: Apache-2.0
// Beams with a footprint, from the trajectory to the points, against closed forms.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "plate_scenes.h"
#include "sub_rays.h"

namespace plotscan::lidar {
namespace {

// How far the share of the sub-rays on one side of a straight edge is from the Gaussian's, at most
// over all edges and turns.
double worst_split(int sub_rays) {
  double most = 0;
  for (int step = 0; step < 720; ++step) {
    const Eigen::Rotation2Dd turn(std::numbers::pi * step / 720);
    std::vector<double> beside;
    for (const Eigen::Vector2d& point : normal_pattern(sub_rays))
      beside.push_back((turn * point).x());
    std::ranges::sort(beside);
    for (int i = 0; i < sub_rays; ++i) {
      const double share =
          0.5 * std::erfc(-beside[static_cast<std::size_t>(i)] / std::numbers::sqrt2);
      most = std::max({most, std::abs(share - static_cast<double>(i) / sub_rays),
                       std::abs(share - static_cast<double>(i + 1) / sub_rays)});
    }
  }
  return most;
}

// The share of the beam that meets the plate is Phi(edge / (sigma R)), R the plate's range.
void expect_split(double edge_m) {
  constexpr double kPlateZ_m = 4;
  constexpr int kSubRays = 100;
  const Hover hover(one_laser());
  const double sigma_rad = hover.sensor.beam->across_rad / 4;
  const Points points = hover.scan(
      plate_over_ground(kPlateZ_m, edge_m),
      {.range_noise_m = 0, .threads = 2, .sub_rays = kSubRays, .returns = ReturnMode::dual});
  const double worst = worst_split(kSubRays);
  double error_sum = 0;
  double shots = 0;
  for (const scan::LabelledPoint& point : points) {
    const double down = hover.down(point);
    if (point.plant != 7 || down < 0.5) continue;
    const double range_m = (kHeight_m - kPlateZ_m) / down;
    const double share = 0.5 * std::erfc(-edge_m / (sigma_rad * range_m) / std::numbers::sqrt2);
    const double seen = point.intensity / (100 * kPlate * down);
    ASSERT_NEAR(seen, share, worst + 0.6 / (100 * kPlate * down));
    error_sum += seen - share;
    ++shots;
  }
  ASSERT_GT(shots, 500);
  EXPECT_NEAR(error_sum / shots, 0, 0.002) << "edge at " << edge_m;
}

TEST(BeamsInScenes, HalfCoveredBeamSplitsItsEnergy) { expect_split(0); }

TEST(BeamsInScenes, AnEdgeAsideSplitsByTheErrorFunction) {
  for (const double edge_m : {-0.002, -0.0007, 0.001, 0.003}) expect_split(edge_m);
}

TEST(BeamsInScenes, DualReturnsThroughAGapOfKnownDepth) {
  constexpr double kPlateZ_m = 3;
  const Hover hover(one_laser());
  const auto content = plate_over_ground(kPlateZ_m, 0);
  const auto scan = [&](ReturnMode mode) {
    return hover.scan(content, {.range_noise_m = 0, .sub_rays = 16, .returns = mode});
  };
  const Points dual = scan(ReturnMode::dual);
  const double off = off_centre(16);
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < dual.size(); ++i) {
    const double down = hover.down(dual[i]);
    if (dual[i].return_count != 2 || dual[i].return_number != 1 || down < 0.4) continue;
    ASSERT_EQ(dual[i + 1].return_number, 2);
    ASSERT_EQ(dual[i + 1].return_count, 2);
    ASSERT_EQ(dual[i + 1].time, dual[i].time);
    const double near_bound_m = half_beam_bound(off, hover, (kHeight_m - kPlateZ_m) / down, down);
    const double far_bound_m = half_beam_bound(off, hover, kHeight_m / down, down);
    ASSERT_NEAR(range_of(dual[i + 1]) - range_of(dual[i]), kPlateZ_m / down,
                near_bound_m + far_bound_m);
    ASSERT_NEAR(dual[i].z, kPlateZ_m, near_bound_m * down);
    ASSERT_NEAR(dual[i + 1].z, 0, far_bound_m * down);
    ASSERT_EQ(dual[i].plant, 7u);
    ASSERT_EQ(dual[i + 1].label, scan::PointClass::ground);
    ++pairs;
  }
  EXPECT_GT(pairs, 900);
  // The plate is nearer and brighter.
  for (const auto& point : scan(ReturnMode::strongest)) {
    if (hover.down(point) < 0.4) continue;
    ASSERT_EQ(point.plant, 7u);
    ASSERT_EQ(point.return_count, 1);
  }
  for (const auto& point : scan(ReturnMode::last)) {
    if (hover.down(point) < 0.4) continue;
    ASSERT_EQ(point.label, scan::PointClass::ground);
    ASSERT_EQ(point.return_number, 1);
  }
}

// Whether a sub-ray of the shot passes the plate's edge, at x = 0, within what single precision
// tells apart there.
bool grazes_edge(const Hover& hover, int sub_rays, std::uint64_t shot, double plate_z_m) {
  constexpr double kEdgeError_m = 5e-6;
  sensor::SequenceShots shots;
  hover.plan.fire(shot, shots);
  const std::vector<Ray> rays =
      testing::sub_rays_of(SubRays(*hover.sensor.beam, sub_rays), ray_of(shots, 0),
                           hover.plan.spin_axis(shot).cast<float>(), shot);
  return std::ranges::any_of(rays, [&](const Ray& ray) {
    const double x_m = (kHeight_m - plate_z_m) * ray.direction.x() / -ray.direction.z();
    return std::abs(x_m) < kEdgeError_m;
  });
}

// The maximum of two pulses that merge: a mean of their ranges weighted by what of each is received
// there. Of 0.1 m it is 0.2 mm from the mean weighted by power.
double merged_peak(double near_m, double near, double far_m, double far) {
  constexpr double kPulse_m = 0.38191;  // standard deviation of 6 ns
  double peak_m = (near * near_m + far * far_m) / (near + far);
  for (int i = 0; i < 100; ++i) {
    const double a = near * std::exp(-0.5 * std::pow((near_m - peak_m) / kPulse_m, 2));
    const double b = far * std::exp(-0.5 * std::pow((far_m - peak_m) / kPulse_m, 2));
    peak_m = (a * near_m + b * far_m) / (a + b);
  }
  return peak_m;
}

// A gap shallower than the pulse gives one point between.
TEST(BeamsInScenes, AShallowEdgeGivesAMixedPixel) {
  constexpr double kPlateZ_m = 0.1;
  const Hover hover(one_laser());
  const double off = off_centre(16);
  int mixed = 0;
  int grazing = 0;
  for (const auto& point :
       hover.scan(plate_over_ground(kPlateZ_m, 0),
                  {.range_noise_m = 0, .sub_rays = 16, .returns = ReturnMode::dual})) {
    const double down = hover.down(point);
    if (down < 0.7) continue;
    if (grazes_edge(hover, 16, hover.shot(point), kPlateZ_m)) {
      ++grazing;
      continue;
    }
    const double near_m = (kHeight_m - kPlateZ_m) / down;
    const double far_m = kHeight_m / down;
    const double near = kPlate / (near_m * near_m);
    const double far = kSoil / (far_m * far_m);
    ASSERT_NEAR(range_of(point), merged_peak(near_m, near, far_m, far),
                half_beam_bound(off, hover, far_m, down));
    ASSERT_EQ(point.return_count, 1);
    ASSERT_EQ(point.plant, 7u);
    ASSERT_NEAR(point.intensity, 50 * (kPlate + kSoil) * down, 1.1);
    ++mixed;
  }
  EXPECT_GT(mixed, 500);
  EXPECT_LT(grazing, mixed / 20);
}

TEST(BeamsInScenes, IntensityFollowsLambertForAnyNumberOfSubRays) {
  const Hover hover(one_laser());
  for (const int sub_rays : {1, 2, 7, 64}) {
    for (const auto& point : hover.scan(ground(), {.range_noise_m = 0, .sub_rays = sub_rays})) {
      const double down = hover.down(point);
      if (down > 0.35) {
        ASSERT_NEAR(point.intensity, 100 * kSoil * down, 0.501) << sub_rays;
        ASSERT_NEAR(range_of(point), kHeight_m / down, 1e-4 / std::pow(down, 4)) << sub_rays;
      }
    }
  }
}

// Soil seen ever flatter: its echo weakens with its cosine and its range, and its pulse is
// stretched by the footprint's depth.
TEST(BeamsInScenes, SoilVanishesWhereTheThresholdSays) {
  const Hover hover(one_laser());
  const sensor::Beam& beam = *hover.sensor.beam;
  const double threshold = beam.faintest_reflectance / std::pow(beam.faintest_range_m, 2);
  const double pulse_m = 0.5 * 299'792'458.0 * beam.pulse_s / (2 * std::sqrt(2 * std::log(2)));
  const auto peak = [&](double range_m) {
    const double down = kHeight_m / range_m;
    const double depth_m =
        beam.along_rad / 4 * range_m * std::sqrt(1 - down * down) / down;  // standard deviation
    return kSoil * down / (range_m * range_m) * pulse_m / std::hypot(pulse_m, depth_m);
  };
  double reach_m = kHeight_m;
  while (peak(reach_m) > threshold) reach_m += 0.01;
  ASSERT_GT(reach_m, 30);
  ASSERT_LT(reach_m, 45);
  std::map<std::uint64_t, double> seen;
  for (const auto& point : hover.scan(ground(), {.range_noise_m = 0, .sub_rays = 64}))
    seen[hover.shot(point)] = range_of(point);
  for (const auto& point :
       hover.scan(ground(), {.range_noise_m = 0})) {  // one ray knows no threshold
    const double range_m = range_of(point);
    if (std::abs(range_m / reach_m - 1) < 0.02) continue;
    ASSERT_EQ(seen.count(hover.shot(point)) == 1, range_m < reach_m)
        << range_m << " of " << reach_m;
  }
  EXPECT_GT(seen.size(), 1000u);
}

}  // namespace
}  // namespace plotscan::lidar
