// SPDX-License-Identifier: Apache-2.0
#include "heights/kriging.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::heights {
namespace {

constexpr Covariance kCovariance = {.signal = 0.3, .length = 0.8, .linear = 0.2};
constexpr double kNoise = 0.02;

double curve(double x, double y) { return 0.7 + 0.2 * std::sin(2 * x) + 0.1 * y; }

struct Known {
  Eigen::MatrixXd places;
  Eigen::VectorXd values;
};

Known known(Eigen::Index count) {
  RandomStream random(3, random_purpose("test"), 0);
  Known data{.places = Eigen::MatrixXd(count, 2), .values = Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    data.places.row(i) << random.uniform(-2, 2), random.uniform(-2, 2);
    data.values(i) = curve(data.places(i, 0), data.places(i, 1)) + kNoise * random.normal();
  }
  return data;
}

TEST(Kriging, FollowsACurveAndKnowsWhereItDoesNot) {
  const Known data = known(150);
  const Kriging kriging(data.places, data.values, std::vector<double>(150, kNoise), kCovariance);
  const Prediction inside = kriging.at(Eigen::Vector2d(0.4, -0.7));
  EXPECT_NEAR(inside.value, curve(0.4, -0.7), 0.02);
  EXPECT_NEAR(inside.sd, kNoise, 0.01);
  EXPECT_GT(kriging.at(Eigen::Vector2d(6, 6)).sd, 0.2);
}

// Leaving a group out by the inverse's blocks is leaving it out.
TEST(Kriging, WithoutOwnGroupIsAFitWithoutIt) {
  const Known data = known(40);
  std::vector<int> groups;
  for (int i = 0; i < 40; ++i) groups.push_back(i % 7);
  const std::vector<Prediction> predictions =
      Kriging(data.places, data.values, std::vector<double>(40, kNoise), kCovariance)
          .without_own_group(groups);
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < 40; ++i)
    if (groups[static_cast<std::size_t>(i)] != 3) others.push_back(i);
  const Kriging rest(data.places(others, Eigen::all), data.values(others),
                     std::vector<double>(others.size(), kNoise), kCovariance);
  for (Eigen::Index i = 3; i < 40; i += 7) {
    const Prediction expected = rest.at(data.places.row(i));
    const Prediction found = predictions[static_cast<std::size_t>(i)];
    // The values' mean, about which both are kriged, hardly matters under a wide level.
    EXPECT_NEAR(found.value, expected.value, 1e-3);
    EXPECT_NEAR(found.sd, expected.sd, 1e-6);
  }
}

}  // namespace
}  // namespace plotscan::heights
