// SPDX-License-Identifier: Apache-2.0
#include "crop/plant_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kGrid_m = 1e-5;
constexpr double kTextureGrid = 1e-4;

// `count` of the indices 0 to last, evenly, with both ends.
std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count) {
  count = std::clamp<std::size_t>(count, 2, size);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i)
    indices.push_back((2 * i * (size - 1) + count - 1) / (2 * (count - 1)));
  return indices;
}

template <class Value>
std::vector<Value> picked(const std::vector<Value>& values,
                          const std::vector<std::size_t>& indices) {
  return list_of(indices, [&](std::size_t index) { return values[index]; });
}

// The share of the path's length at each of its points.
std::vector<double> length_shares(const std::vector<Vector3d>& path) {
  std::vector<double> shares = {0};
  for (std::size_t i = 1; i < path.size(); ++i)
    shares.push_back(shares.back() + (path[i] - path[i - 1]).norm());
  for (double& share : shares) share /= std::max(shares.back(), kGrid_m);
  shares.back() = 1;
  return shares;
}

// A stalk of no length, as of a leaflet that sits on its petiole.
bool is_point(const std::vector<Vector3d>& path) {
  return std::ranges::count(path, path.front()) == std::ssize(path);
}

// The path's direction at a point: of the line between its neighbours.
Vector3d tangent(const std::vector<Vector3d>& path, std::size_t i) {
  return (path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]).normalized();
}

// The part of `vector` that is perpendicular to `axis`, of length 1; another perpendicular where
// there is none.
Vector3d perpendicular(const Vector3d& vector, const Vector3d& axis) {
  const Vector3d part = vector - vector.dot(axis) * axis;
  return part.norm() > 1e-6 ? part.normalized() : axis.unitOrthogonal();
}

double flat_area(const std::vector<Vector3d>& midrib, const std::vector<double>& half_width_m) {
  double area = 0;
  for (std::size_t i = 1; i < midrib.size(); ++i)
    area += (midrib[i] - midrib[i - 1]).norm() * (half_width_m[i] + half_width_m[i - 1]);
  return area;
}

// The blade with few points, widened so that it keeps its area.
Blade thinned(const Blade& blade) {
  const auto kept =
      spread_indices(blade.midrib.size(), static_cast<std::size_t>(blade.light_points));
  Blade thin = blade;
  thin.midrib = picked(blade.midrib, kept);
  thin.half_width_m = picked(blade.half_width_m, kept);
  if (blade.across.size() > 1) thin.across = picked(blade.across, kept);
  const double area = flat_area(thin.midrib, thin.half_width_m);
  const double factor = area > 0 ? flat_area(blade.midrib, blade.half_width_m) / area : 1;
  for (double& half : thin.half_width_m) half *= factor;
  return thin;
}

Tube thinned(const Tube& tube) {
  const auto kept = spread_indices(tube.path.size(), static_cast<std::size_t>(tube.light_points));
  Tube thin = tube;
  thin.path = picked(tube.path, kept);
  thin.radius_m = picked(tube.radius_m, kept);
  thin.sides = tube.light_sides;
  return thin;
}

}  // namespace

void PlantBuilder::tube(const Tube& full, const std::string& material) {
  check(full.path.size() >= 2 && full.radius_m.size() == full.path.size(), "a tube's points");
  use(material);
  if (is_point(full.path)) return;
  const Tube tube = light() ? thinned(full) : full;
  const std::vector<double> shares = length_shares(tube.path);
  Vector3d across = tube.across;
  Row last;
  for (std::size_t i = 0; i < tube.path.size(); ++i) {
    // Carried along the path, so that the tube does not turn about itself.
    Eigen::Matrix3d frame;
    frame.col(2) = tangent(tube.path, i);
    across = perpendicular(across, frame.col(2));
    frame.col(0) = across;
    frame.col(1) = frame.col(2).cross(across);
    Row row = tube_row(tube.path[i], frame, tube.radius_m[i], tube, tube.sides, shares[i]);
    if (i > 0) join(last, row);
    last = std::move(row);
  }
  if (!tube.closed_tip || tube.sides < 3) return;
  for (std::size_t i = 2; i + 1 < last.size(); ++i) add_triangle(last[0], last[i - 1], last[i]);
}

// The ring's last vertex lies on its first, so that a texture closes.
PlantBuilder::Row PlantBuilder::tube_row(const Vector3d& centre, const Eigen::Matrix3d& frame,
                                         double radius_m, const Tube& tube, int sides, double v) {
  if (radius_m <= 0) return {add_vertex(centre, 0.5, v)};
  Row row;
  const int points = sides == 2 ? 2 : sides + 1;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (sides == 2 ? 1 : sides);
    const double angle = (sides == 2 ? 1 : 2) * kPi * (i == sides ? 0 : share);
    const Vector3d offset = radius_m * (std::cos(angle) * frame.col(0) +
                                        tube.flatness * std::sin(angle) * frame.col(1));
    row.push_back(add_vertex(centre + offset, share, v));
  }
  return row;
}

void PlantBuilder::blade(const Blade& full, const std::string& material) {
  check(full.midrib.size() >= 2 && full.half_width_m.size() == full.midrib.size() &&
            (full.across.size() == 1 || full.across.size() == full.midrib.size()),
        "a blade's points");
  use(material);
  const Blade blade = light() ? thinned(full) : full;
  const std::vector<double> shares = length_shares(blade.midrib);
  const double widest =
      std::max(*std::max_element(blade.half_width_m.begin(), blade.half_width_m.end()), kGrid_m);
  Row last;
  for (std::size_t i = 0; i < blade.midrib.size(); ++i) {
    const Vector3d along = tangent(blade.midrib, i);
    const Vector3d across = perpendicular(blade.across[blade.across.size() == 1 ? 0 : i], along);
    const double half = blade.half_width_m[i];
    const double fold = light() ? 0 : blade.fold_rad;
    const Vector3d up = half * std::sin(fold) * along.cross(across);
    const Vector3d aside = half * std::cos(fold) * across;
    const double u = half / widest / 2;
    Row row;
    if (half > 0) row.push_back(add_vertex(blade.midrib[i] + aside + up, 0.5 - u, shares[i]));
    if (half <= 0 || !light()) row.push_back(add_vertex(blade.midrib[i], 0.5, shares[i]));
    if (half > 0) row.push_back(add_vertex(blade.midrib[i] - aside + up, 0.5 + u, shares[i]));
    if (i > 0) join(last, row);
    last = std::move(row);
  }
}

void PlantBuilder::ellipsoid(const Vector3d& centre, const Vector3d& axis, const Vector3d& across,
                             const Vector3d& half_axes_m, const std::string& material) {
  constexpr int kPoints = 5;
  Tube tube{.path = {},
            .radius_m = {},
            .sides = 6,
            .closed_tip = false,
            .across = across,
            .flatness = half_axes_m.z() / half_axes_m.y(),
            .light_points = 3,
            .light_sides = 3};
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kPi * i / (kPoints - 1);
    tube.path.push_back(centre - std::cos(angle) * half_axes_m.x() * axis.normalized());
    const bool end = i == 0 || i == kPoints - 1;
    tube.radius_m.push_back(end ? 0 : half_axes_m.y() * std::sin(angle));
  }
  this->tube(tube, material);
}

mesh::Mesh PlantBuilder::take(bool textured) {
  if (!textured) mesh_.texture_coordinates.clear();
  return std::exchange(mesh_, {});
}

// Rows of one vertex (a point), two (edges) or as many as each other.
void PlantBuilder::join(const Row& lower, const Row& upper) {
  const std::size_t steps = std::max(lower.size(), upper.size());
  const auto at = [](const Row& row, std::size_t i) { return row[row.size() == 1 ? 0 : i]; };
  for (std::size_t i = 0; i + 1 < steps; ++i) {
    add_triangle(at(lower, i), at(lower, i + 1), at(upper, i + 1));
    add_triangle(at(lower, i), at(upper, i + 1), at(upper, i));
  }
}

std::uint32_t PlantBuilder::add_vertex(const Vector3d& point, double u, double v) {
  const Vector3d whole = (point / kGrid_m).array().round();
  mesh_.vertices.emplace_back((whole * kGrid_m).cast<float>());
  const Eigen::Vector2d texture = (Eigen::Vector2d(u, v) / kTextureGrid).array().round();
  mesh_.texture_coordinates.emplace_back((texture * kTextureGrid).cast<float>());
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

// Triangles that rounding leaves without an area are left out.
void PlantBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Eigen::Vector3f ab = mesh_.vertices[b] - mesh_.vertices[a];
  const Eigen::Vector3f ac = mesh_.vertices[c] - mesh_.vertices[a];
  if (ab.isZero(0) || ac.isZero(0) || mesh_.vertices[b] == mesh_.vertices[c]) return;
  mesh_.triangles.push_back({a, b, c});
  mesh_.triangle_material.push_back(material_);
}

void PlantBuilder::use(const std::string& material) {
  const auto colour = colours_.find(material);
  check(colour != colours_.end(), "the crop's file has a colour of " + material);
  const auto found = std::ranges::find(mesh_.materials, material, &mesh::Material::name);
  material_ = static_cast<std::uint16_t>(found - mesh_.materials.begin());
  if (found == mesh_.materials.end())
    mesh_.materials.push_back({.name = material, .colour = colour->second, .texture = {}});
}

}  // namespace plotscan::crop
