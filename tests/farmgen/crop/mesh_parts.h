// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::testing {

// The vertices of a material's triangles.
inline std::vector<Eigen::Vector3f> vertices_of(const mesh::Mesh& mesh,
                                                const std::string& material) {
  std::vector<Eigen::Vector3f> vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.materials[mesh.material_of(i)].name != material) continue;
    for (const auto vertex : mesh.triangles[i]) vertices.push_back(mesh.vertices[vertex]);
  }
  return vertices;
}

inline float lowest(const std::vector<Eigen::Vector3f>& vertices) {
  float z = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& vertex : vertices) z = std::min(z, vertex.z());
  return z;
}

inline float highest(const std::vector<Eigen::Vector3f>& vertices) {
  float z = -std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& vertex : vertices) z = std::max(z, vertex.z());
  return z;
}

// The axis about which the azimuths of points lie (Mardia's axial mean), weighted by distance
// squared, and how narrowly: 1 for one plane through the stem, about 0 for all around it.
inline std::complex<double> axial_mean(const std::vector<Eigen::Vector3f>& points) {
  std::complex<double> sum = 0;
  double weights = 0;
  for (const Eigen::Vector3f& point : points) {
    const double weight = point.head<2>().squaredNorm();
    sum += std::polar(weight, 2.0 * std::atan2(point.y(), point.x()));
    weights += weight;
  }
  return sum / weights;
}

}  // namespace plotscan::testing
