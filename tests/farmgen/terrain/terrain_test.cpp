// SPDX-License-Identifier: Apache-2.0
#include "terrain/terrain.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "temporary_folder.h"

namespace plotscan::terrain {
namespace {

using plotscan::testing::message_of;
using ::testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

// side x side squares of two triangles over the unit square. With skew 1 the inner vertices are
// moved about at random; else the lines are unevenly spaced (their positions are powers of the
// step), so that the triangles' sizes differ by orders of magnitude.
Surface bumpy_square(std::uint32_t side, double skew, std::uint64_t seed) {
  Surface surface;
  for (std::uint32_t row = 0; row <= side; ++row) {
    for (std::uint32_t column = 0; column <= side; ++column) {
      RandomStream random(seed, random_purpose("test/vertex"), row * (side + 1) + column);
      const bool inner = row > 0 && column > 0 && row < side && column < side;
      const double shift = inner && skew == 1.0 ? 0.2 : 0.0;
      const double x = (column + random.uniform(-shift, shift)) / side;
      const double y = (row + random.uniform(-shift, shift)) / side;
      surface.vertices.emplace_back(std::pow(x, skew), std::pow(y, skew), random.uniform(-1, 1));
      if (row == side || column == side) continue;
      const std::uint32_t a = row * (side + 1) + column;
      const std::uint32_t b = a + side + 1;
      surface.triangles.push_back({a, a + 1, b});
      surface.triangles.push_back({b, a + 1, b + 1});
    }
  }
  return surface;
}

// The height by solving for the plane of every triangle whose edges hold the point: another
// formula than Terrain's, over all triangles.
std::optional<double> brute_force_height(const Terrain& terrain, double x, double y) {
  for (const Triangle& triangle : terrain.triangles()) {
    Eigen::Matrix3d rows;
    Eigen::Vector3d heights;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& vertex = terrain.vertices()[triangle[i]];
      rows.row(i) << vertex.x(), vertex.y(), 1;
      heights[i] = vertex.z();
    }
    const Eigen::Matrix3d inverse = rows.inverse();
    const Eigen::RowVector3d shares = Eigen::RowVector3d(x, y, 1) * inverse;
    if (shares.minCoeff() >= -1e-9) return shares.dot(heights);
  }
  return std::nullopt;
}

// Along a random walk that leaves the square now and then, and beyond what rounding tells apart.
TEST(Terrain, HeightNearTheLastPlaceIsTheHeight) {
  const Surface surface = bumpy_square(24, 1.0, 3);
  const Terrain terrain(surface.vertices, surface.triangles);
  RandomStream random(9, random_purpose("test/walk"), 0);
  Eigen::Vector2d place(0.5, 0.5);
  std::uint32_t triangle = 0;
  int inside = 0, outside = 0;
  for (int i = 0; i < 20000; ++i) {
    place += Eigen::Vector2d(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    place = place.cwiseMax(-0.05).cwiseMin(1.05);
    const auto near = terrain.height_near(place.x(), place.y(), triangle);
    const auto height = terrain.height(place.x(), place.y());
    ASSERT_EQ(near.has_value(), height.has_value());
    (height ? inside : outside) += 1;
    if (!height) continue;
    ASSERT_NEAR(*near, *height, 1e-12);
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 100);
}

TEST(Terrain, HeightAgreesWithBruteForceOverAllTriangles) {
  for (const double skew : {1.0, 6.0}) {
    const Surface surface = bumpy_square(24, skew, 7);
    const Terrain terrain(surface.vertices, surface.triangles);
    RandomStream random(7, random_purpose("test/points"), 0);
    for (int i = 0; i < 3000; ++i) {
      const double x = std::pow(random.uniform(), skew);
      const double y = std::pow(random.uniform(), skew);
      const auto expected = brute_force_height(terrain, x, y);
      const auto height = terrain.height(x, y);
      ASSERT_TRUE(expected && height) << "at " << x << ", " << y;
      // The inverse of a sliver's matrix is only good to about 1e-7 where triangles are minute.
      ASSERT_NEAR(*height, *expected, skew == 1.0 ? 1e-10 : 1e-5) << "at " << x << ", " << y;
    }
  }
}

TEST(Terrain, HeightIsExactAtVertices) {
  const Surface surface = bumpy_square(40, 3.0, 3);
  const Terrain terrain(surface.vertices, surface.triangles);
  for (const Eigen::Vector3d& vertex : surface.vertices) {
    ASSERT_EQ(terrain.height(vertex.x(), vertex.y()), vertex.z());
  }
}

TEST(Terrain, HeightAlongEdgesIsLinearAndWithoutGaps) {
  const Surface surface = bumpy_square(30, 1.0, 5);
  const Terrain terrain(surface.vertices, surface.triangles);
  RandomStream random(5, random_purpose("test/edges"), 0);
  for (const Triangle& triangle : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = surface.vertices[triangle[i]];
      const Eigen::Vector3d& b = surface.vertices[triangle[(i + 1) % 3]];
      const Eigen::Vector3d point = a + random.uniform() * (b - a);
      const auto height = terrain.height(point.x(), point.y());
      ASSERT_TRUE(height) << "gap at " << point.transpose();
      ASSERT_NEAR(*height, point.z(), 1e-12);
    }
  }
}

TEST(Terrain, HeightIsAbsentOutside) {
  const Surface surface = bumpy_square(5, 1.0, 1);
  const Terrain terrain(surface.vertices, surface.triangles);
  EXPECT_TRUE(terrain.height(0, 0));
  EXPECT_TRUE(terrain.height(1, 0.5));
  for (const auto& [x, y] : {std::pair{-1e-6, 0.5}, {1 + 1e-6, 0.5}, {0.5, -1e-6}, {1e300, 0.5}}) {
    EXPECT_FALSE(terrain.height(x, y)) << x << ", " << y;
  }
  EXPECT_FALSE(terrain.height(std::numeric_limits<double>::quiet_NaN(), 0.5));
  EXPECT_FALSE(terrain.height(std::numeric_limits<double>::infinity(), 0.5));
}

TEST(Terrain, HighestSurfaceCountsAndWindingDoesNot) {
  const std::vector<Eigen::Vector3d> vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1},
                                                 {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Terrain terrain(vertices, {{5, 4, 3}, {0, 2, 1}, {0, 1, 4}});
  EXPECT_EQ(terrain.height(0.25, 0.25), 1.0);
  EXPECT_EQ(terrain.triangles().size(), 2u) << "the vertical triangle is dropped";
  EXPECT_EQ(terrain.triangles()[0], (Triangle{5, 3, 4}));
}

TEST(Terrain, ManyTrianglesAboutOneVertexKeepTheGridSmall) {
  std::vector<Eigen::Vector3d> vertices = {{0, 0, 5}};
  std::vector<Triangle> triangles;
  constexpr std::uint32_t kCount = 5000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * M_PI * i / kCount;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    triangles.push_back({0, i + 1, (i + 1) % kCount + 1});
  }
  const Terrain terrain(vertices, triangles);
  EXPECT_EQ(terrain.height(0, 0), 5.0);
  EXPECT_NEAR(terrain.height(0.3, 0.4).value(), 2.5, 1e-5);
}

TEST(Terrain, RefusesBrokenMeshes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InputError>([&] {
                Terrain({{0, 0, nan}}, {});
              }),
              HasSubstr("vertex 0 is not finite"));
  EXPECT_THAT(message_of<InputError>([&] {
                Terrain({{0, 0, 0}}, {{0, 0, 7}});
              }),
              HasSubstr("triangle 0 names vertex 7 of 1"));
  EXPECT_THAT(message_of<InputError>([&] {
                Terrain({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}});
              }),
              HasSubstr("no triangle with an area"));
}

}  // namespace
}  // namespace plotscan::terrain
