// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "gazebo/internal/primitive_meshes.h"

namespace plotscan::gazebo {
namespace {

using Loop = std::vector<Eigen::Vector2d>;

// Of the triangles in the plane z = 0.
double bottom_area_m2(const mesh::Mesh& mesh) {
  double area_m2 = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& first = mesh.vertices[a];
    const Eigen::Vector3f one = mesh.vertices[b] - first, other = mesh.vertices[c] - first;
    if (first.z() == 0 && one.z() == 0 && other.z() == 0) area_m2 += 0.5 * one.cross(other).norm();
  }
  return area_m2;
}

// A square with a square hole, as two loops, and as one that runs along a bridge to the hole and
// back. Wherever the loop begins, the bridge is no edge of the area.
TEST(Extruded, ABridgeToAHoleIsNoEdge) {
  const Loop outer = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const Loop hole = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_NEAR(bottom_area_m2(extruded({outer, hole}, 1)), 12, 1e-5);
  Loop keyhole = outer;
  keyhole.insert(keyhole.end(), {{0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
  for (std::size_t i = 0; i < keyhole.size(); ++i) {
    std::rotate(keyhole.begin(), keyhole.begin() + 1, keyhole.end());
    EXPECT_NEAR(bottom_area_m2(extruded({keyhole}, 1)), 12, 1e-5) << i;
    Loop back(keyhole.rbegin(), keyhole.rend());
    EXPECT_NEAR(bottom_area_m2(extruded({back}, 1)), 12, 1e-5) << i;
  }
}

}  // namespace
}  // namespace plotscan::gazebo
