// SPDX-License-Identifier: Apache-2.0
#include "flight/wind.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace plotscan::flight {
namespace {

// Mean of the products of two values of a component `lag_s` apart.
double covariance(const std::vector<Wind>& winds, double duration_s, const Eigen::Vector3d& axis,
                  double lag_s) {
  double sum = 0;
  int count = 0;
  for (const Wind& wind : winds) {
    for (double t = 0; t + lag_s < duration_s; t += 0.5, ++count) {
      sum += axis.dot(wind.velocity_m_s(t) - wind.mean_m_s()) *
             axis.dot(wind.velocity_m_s(t + lag_s) - wind.mean_m_s());
    }
  }
  return sum / count;
}

TEST(Wind, BlowsFromWhereMeteorologySays) {
  const auto mean = [](double from_deg) {
    return Wind({.mean_m_s = 3, .from_deg = from_deg}, 1).mean_m_s();
  };
  EXPECT_NEAR((mean(0) - Eigen::Vector3d(0, -3, 0)).norm(), 0, 1e-15);   // north wind
  EXPECT_NEAR((mean(90) - Eigen::Vector3d(-3, 0, 0)).norm(), 0, 1e-15);  // east wind
  EXPECT_NEAR((mean(270) - Eigen::Vector3d(3, 0, 0)).norm(), 0, 1e-15);  // west wind
}

// MIL-F-8785C's formulas, worked by hand in feet for 20 ft and 15 knots, its light turbulence:
// sigma_w = 0.1 W20, sigma_u = sigma_w / 0.19346^0.4, L_u = 20 ft / 0.19346^1.2, L_w = 20 ft.
TEST(Wind, ScalesAreThoseOfTheSpecification) {
  const double by_specification = 0.1 / std::pow(0.19346, 0.4);
  EXPECT_NEAR(by_specification, 0.193, 1e-3);
  const GustScales scales =
      gust_scales({.mean_m_s = 7.717, .turbulence = by_specification, .height_m = 6.096});
  EXPECT_NEAR(scales.sigma_m_s.x(), 1.4885, 1e-3);
  EXPECT_EQ(scales.sigma_m_s.y(), scales.sigma_m_s.x());
  EXPECT_NEAR(scales.sigma_m_s.z(), 0.7717, 1e-9);
  EXPECT_NEAR(scales.length_m.x(), 43.76, 0.01);
  EXPECT_NEAR(scales.length_m.z(), 6.096, 1e-12);
  // The model has no heights below 10 ft.
  EXPECT_NEAR(gust_scales({.mean_m_s = 1, .height_m = 0.5}).length_m.z(), 3.048, 1e-12);
}

// Against the closed forms of the Dryden correlations. 40 hours at T = 11 s (along, across) hold
// some 6500 independent pieces: a variance's standard error is below 2 %, a correlation's too; the
// bounds are four of them.
TEST(Wind, GustsHaveTheModelsDeviationsAndCorrelations) {
  constexpr double kDuration_s = 4 * 3600;
  WindOptions options{.mean_m_s = 5, .from_deg = 270, .turbulence = 0.2};
  const GustScales scales = gust_scales(options);
  std::vector<Wind> winds;
  for (options.seed = 0; options.seed < 10; ++options.seed)
    winds.emplace_back(options, kDuration_s);
  for (int axis = 0; axis < 3; ++axis) {
    const double variance = scales.sigma_m_s[axis] * scales.sigma_m_s[axis];
    const double time_s = scales.length_m[axis] / 5;
    for (const double lag : {0.0, 0.5, 1.0, 2.0, 4.0}) {
      const double model = axis == 0 ? std::exp(-lag) : (1 - lag / 2) * std::exp(-lag);
      EXPECT_NEAR(
          covariance(winds, kDuration_s, Eigen::Vector3d::Unit(axis), lag * time_s) / variance,
          model, 0.08)
          << "axis " << axis << ", lag " << lag << " T";
    }
  }
}

// A slow wind's gusts last minutes: the filters' steps are then next to nothing.
TEST(Wind, SlowGustsHaveTheirDeviationToo) {
  const WindOptions options{.mean_m_s = 0.05, .turbulence = 0.2};
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    WindOptions seeded = options;
    seeded.seed = seed;
    const Wind wind(seeded, 1);
    sum += (wind.velocity_m_s(1) - wind.mean_m_s()).squaredNorm();
  }
  EXPECT_NEAR(sum / 1500 / gust_scales(options).sigma_m_s.squaredNorm(), 1, 0.08);
}

TEST(Wind, IsTheSameWhateverWasAskedAndHoweverLongTheFlight) {
  const WindOptions options{.mean_m_s = 4, .seed = 7};
  const Wind brief(options, 10);
  const Wind lasting(options, 1000);
  const Eigen::Vector3d late = lasting.velocity_m_s(900);
  for (double t = 10; t >= -Wind::kLeadIn_s; t -= 0.37)
    ASSERT_EQ(brief.velocity_m_s(t), lasting.velocity_m_s(t)) << t;
  EXPECT_EQ(lasting.velocity_m_s(900), late);
  EXPECT_NE(Wind({.mean_m_s = 4, .seed = 8}, 10).velocity_m_s(5), brief.velocity_m_s(5));
}

TEST(Wind, CalmIsCalmAndSteadyIsSteady) {
  EXPECT_EQ(Wind({.turbulence = 0.5}, 60).velocity_m_s(30), Eigen::Vector3d::Zero());
  const Wind steady({.mean_m_s = 4, .turbulence = 0}, 60);
  EXPECT_EQ(steady.velocity_m_s(30), steady.mean_m_s());
}

}  // namespace
}  // namespace plotscan::flight
