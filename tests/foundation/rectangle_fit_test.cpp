// SPDX-License-Identifier: Apache-2.0
#include "core/internal/rectangle_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan {
namespace {

std::vector<Eigen::Vector2d> jittered(const PlotBox& box, double jitter_m, RandomStream& random) {
  std::vector<Eigen::Vector2d> ring;
  for (const Eigen::Vector2d& corner : box.corners())
    ring.emplace_back(corner + jitter_m * Eigen::Vector2d(random.normal(), random.normal()));
  return ring;
}

// Each corner with the polygon's own, whichever corner the box counts from.
double squares_m2(const PlotBox& box, const std::vector<Eigen::Vector2d>& ring) {
  const auto corners = box.corners();
  double least = 1e9;
  for (std::size_t shift = 0; shift < 4; ++shift) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += (corners[(i + shift) % 4] - ring[i]).squaredNorm();
    least = std::min(least, sum);
  }
  return least;
}

// The oracle: no other rectangle nearby, in any of its five numbers, is nearer to the corners.
TEST(RectangleFit, IsTheLeastSumOfSquares) {
  RandomStream random(5, random_purpose("test/rectangles"), 0);
  for (int i = 0; i < 50; ++i) {
    const PlotBox box{.center = {random.uniform(-9, 9), random.uniform(-9, 9)},
                      .width_m = random.uniform(1, 2),
                      .length_m = random.uniform(3, 9),
                      .heading_rad = random.uniform(0, 3.1)};
    const auto ring = jittered(box, 0.03, random);
    const auto fit = fit_rectangle(ring);
    ASSERT_TRUE(fit);
    EXPECT_LT(fit->off_m, 0.2);
    const double least = squares_m2(fit->box, ring);
    for (const double step : {-1e-3, 1e-3}) {
      for (int number = 0; number < 5; ++number) {
        PlotBox other = fit->box;
        (number == 0   ? other.center.x()
         : number == 1 ? other.center.y()
         : number == 2 ? other.width_m
         : number == 3 ? other.length_m
                       : other.heading_rad) += step;
        EXPECT_GT(squares_m2(other, ring), least);
      }
    }
  }
}

TEST(RectangleFit, SeesEveryVertexThatIsOff) {
  const auto off_m = [](std::vector<Eigen::Vector2d> ring) {
    const auto fit = fit_rectangle(std::move(ring));
    return fit ? fit->off_m : -1;
  };
  EXPECT_NEAR(off_m({{0, 0}, {2, 0}, {4, 0}, {4, 1}, {0, 1}, {0, 0}}), 0, 1e-12);
  EXPECT_NEAR(off_m({{0, 0}, {2, -0.3}, {4, 0}, {4, 1}, {0, 1}}), 0.3, 1e-12);
  EXPECT_GT(off_m({{0, 0}, {4, 1}, {4, 0}, {0, 1}}), 0.4);                  // a bow tie
  EXPECT_GT(off_m({{0, 0}, {4, 0}, {4, 1}, {2, 1}, {2, 3}, {0, 3}}), 0.5);  // an L
  EXPECT_EQ(off_m({{0, 0}, {4, 0}, {4, 1}, {0, 0}}), -1);                   // a triangle
  EXPECT_EQ(off_m(std::vector<Eigen::Vector2d>(1002, Eigen::Vector2d::Zero())), -1);
}

TEST(RectangleFit, TakesDecimetresAndNoMore) {
  EXPECT_DOUBLE_EQ(rectangle_tolerance_m({.width_m = 1.5, .length_m = 2}), 0.1);
  EXPECT_DOUBLE_EQ(rectangle_tolerance_m({.width_m = 3, .length_m = 4}), 0.15);
  EXPECT_DOUBLE_EQ(rectangle_tolerance_m({.width_m = 0.2, .length_m = 4}), 0.05);
}

}  // namespace
}  // namespace plotscan
