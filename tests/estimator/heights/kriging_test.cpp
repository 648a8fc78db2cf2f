// SPDX-License-Identifier: Apache-2.0
#include "heights/kriging.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::heights {
namespace {

constexpr Covariance kCovariance = {.linear = 0.5, .noise = 0.1};

Eigen::RowVector2d curves(double x, double y) {
  return {0.7 + 0.2 * std::sin(2 * x) + 0.1 * y, 3 * std::cos(x + y)};
}

struct Known {
  Eigen::MatrixXd places;
  Eigen::MatrixXd values;
};

Known known(Eigen::Index count) {
  constexpr double kNoise = 0.02;
  RandomStream random(3, random_purpose("test"), 0);
  Known data{.places = Eigen::MatrixXd(count, 2), .values = Eigen::MatrixXd(count, 2)};
  for (Eigen::Index i = 0; i < count; ++i) {
    data.places.row(i) << random.uniform(-2, 2), random.uniform(-2, 2);
    data.values.row(i) = curves(data.places(i, 0), data.places(i, 1));
    data.values(i, 0) += kNoise * random.normal();
    data.values(i, 1) += kNoise * random.normal();
  }
  return data;
}

TEST(Kriging, FollowsCurvesAndKnowsWhereItDoesNot) {
  const Known data = known(200);
  const Kriging kriging(data.places, data.values, std::vector<double>(200, 1), kCovariance);
  const Eigen::Vector2d place(0.4, -0.7);
  const Prediction inside = kriging.at(place, 1);
  EXPECT_NEAR(inside.values(0), curves(0.4, -0.7)(0), 0.02);
  EXPECT_NEAR(inside.values(1), curves(0.4, -0.7)(1), 0.1);
  EXPECT_LT(inside.novelty, 0.1);
  EXPECT_GT(kriging.novelty(Eigen::Vector2d(8, 8)), 0.9);
  EXPECT_GT(kriging.at(Eigen::Vector2d(8, 8), 1).sds(0), 5 * inside.sds(0));
  EXPECT_GT(kriging.at(place, 3).sds(0), 2 * inside.sds(0));
}

// One known value v at x, about which a second lies at -x with value -v: by hand, with the level's
// part cancelled, the weights are v / (k(0) - k(2x) + noise) each, linear part included.
TEST(Kriging, IsTheClosedFormOfTwoPlaces) {
  constexpr double kX = 0.6;
  constexpr double kValue = 2;
  const Eigen::MatrixXd places = (Eigen::MatrixXd(2, 1) << kX, -kX).finished();
  const Eigen::MatrixXd values = (Eigen::MatrixXd(2, 1) << kValue, -kValue).finished();
  const Kriging kriging(places, values, {1, 1}, kCovariance);
  const auto odd = [&](double at) {  // covariance with the first place less that with the second
    return std::exp(-0.5 * (at - kX) * (at - kX)) - std::exp(-0.5 * (at + kX) * (at + kX)) +
           2 * kCovariance.linear * kCovariance.linear * at * kX;
  };
  const double expected = kValue * odd(0.3) / (odd(kX) + kCovariance.noise * kCovariance.noise);
  EXPECT_NEAR(kriging.at(Eigen::VectorXd::Constant(1, 0.3), 1).values(0), expected, 1e-9);
}

}  // namespace
}  // namespace plotscan::heights
