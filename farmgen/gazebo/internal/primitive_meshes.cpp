// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/primitive_meshes.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.h"

namespace plotscan::gazebo {
namespace {

constexpr std::uint32_t kAround = 360;
constexpr std::uint32_t kRings = kAround / 4;  // from a pole of a ball to its equator

struct ProfilePoint {
  double radius = 0;
  double z = 0;
};

// Turns a profile from a lowest to a highest point, both on the axis, about z.
mesh::Mesh turned(const std::vector<ProfilePoint>& profile) {
  mesh::Mesh mesh;
  const auto rings = static_cast<std::uint32_t>(profile.size()) - 2;
  mesh.vertices.emplace_back(0, 0, profile.front().z);
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2 * kPi * i / kAround;
      const auto& [radius, z] = profile[ring];
      mesh.vertices.emplace_back(
          Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>());
    }
  }
  mesh.vertices.emplace_back(0, 0, profile.back().z);
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround;
    mesh.triangles.push_back({0, 1 + next, 1 + i});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t low = 1 + ring * kAround;
      const std::uint32_t high = low + kAround;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
    const std::uint32_t last = 1 + (rings - 1) * kAround;
    mesh.triangles.push_back({last + i, last + next, top});
  }
  return mesh;
}

// Adds a quarter of a circle about (0, z), from the angle (radians from the equator) to a right
// angle further.
void add_quarter(std::vector<ProfilePoint>& profile, double radius, double z, double from_rad) {
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const double angle = from_rad + kPi / 2 * ring / kRings;
    profile.push_back({radius * std::cos(angle), z + radius * std::sin(angle)});
  }
}

}  // namespace

mesh::Mesh unit_box() {
  mesh::Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1) - 0.5F, (i >> 1 & 1) - 0.5F, (i >> 2) - 0.5F);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

mesh::Mesh unit_plane() {
  return {.vertices = {{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

mesh::Mesh unit_sphere() { return capsule(1, 0); }

mesh::Mesh unit_cylinder() { return turned({{0, -0.5}, {1, -0.5}, {1, 0.5}, {0, 0.5}}); }

mesh::Mesh capsule(double radius_m, double length_m) {
  std::vector<ProfilePoint> profile;
  add_quarter(profile, radius_m, -length_m / 2, -kPi / 2);
  if (length_m == 0) profile.pop_back();  // a ball has one equator
  add_quarter(profile, radius_m, length_m / 2, 0);
  return turned(profile);
}

void put_centre_at_origin(mesh::Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (vertex.cast<double>() - box.center()).cast<float>();
}

}  // namespace plotscan::gazebo
