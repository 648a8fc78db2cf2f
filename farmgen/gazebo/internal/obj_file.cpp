// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/obj_file.h"

#include <array>
#include <cmath>

#include "core/number_text.h"

namespace plotscan::gazebo {
namespace {

constexpr std::size_t kBuffer = 1 << 20;

// The octahedral map of a direction to [0, 1]^2 and back (Meyer et al. 2010, On Floating-Point
// Normal Vectors, section 3).
Eigen::Vector2d square_from_direction(const Eigen::Vector3d& d) {
  const Eigen::Vector3d n = d / d.cwiseAbs().sum();
  Eigen::Vector2d p = n.head<2>();
  if (n.z() < 0) {
    p = {(1 - std::abs(n.y())) * std::copysign(1.0, n.x()),
         (1 - std::abs(n.x())) * std::copysign(1.0, n.y())};
  }
  return (p.array() + 1) / 2;
}

Eigen::Vector3d direction_from_square(const Eigen::Vector2d& square) {
  const Eigen::Vector2d p = square.array() * 2 - 1;
  Eigen::Vector3d n(p.x(), p.y(), 1 - std::abs(p.x()) - std::abs(p.y()));
  if (n.z() < 0) {
    n.head<2>() = Eigen::Vector2d((1 - std::abs(p.y())) * std::copysign(1.0, p.x()),
                                  (1 - std::abs(p.x())) * std::copysign(1.0, p.y()));
  }
  return n.normalized();
}

}  // namespace

ObjFile::ObjFile(const std::filesystem::path& path, const std::string& materials, int normal_steps)
    : out_(path),
      steps_(normal_steps),
      normal_ids_(static_cast<std::size_t>(normal_steps + 1) * (normal_steps + 1), 0) {
  buffer_ = "# metres, z up\nmtllib " + materials + "\n";
}

void ObjFile::use_material(const std::string& name) { buffer_ += "usemtl " + name + "\n"; }

void ObjFile::put_numbers(std::string_view key, std::initializer_list<float> values) {
  buffer_ += key;
  for (const float value : values) {
    buffer_ += ' ';
    buffer_.append(NumberText(value + 0.0F));
  }
  buffer_ += '\n';
}

void ObjFile::flush() {
  out_ << buffer_;
  buffer_.clear();
}

std::uint32_t ObjFile::normal_id(const Eigen::Vector3d& normal) {
  const Eigen::Vector2d square = (square_from_direction(normal) * steps_).array().round();
  const auto cell =
      static_cast<std::size_t>(square.y()) * (steps_ + 1) + static_cast<std::size_t>(square.x());
  std::uint32_t& id = normal_ids_[cell];
  if (id == 0) {
    id = ++normals_;
    const Eigen::Vector3d rounded = direction_from_square(square / steps_);
    const auto digits = [](double value) {
      return static_cast<float>(std::round(value * 1e4) / 1e4);
    };
    put_numbers("vn", {digits(rounded.x()), digits(rounded.y()), digits(rounded.z())});
  }
  return id;
}

void ObjFile::put_vertices(const Surface& surface, const Eigen::Affine3d& file_from_surface) {
  for (const Eigen::Vector3f& vertex : surface.vertices) {
    const Eigen::Vector3f placed = (file_from_surface * vertex.cast<double>()).cast<float>();
    put_numbers("v", {placed.x(), placed.y(), placed.z()});
  }
}

void ObjFile::put_normals(const Surface& surface, const Eigen::Affine3d& file_from_surface,
                          bool both_sides) {
  const Eigen::Matrix3d turn = file_from_surface.linear().inverse().transpose();
  front_.clear();
  back_.clear();
  for (const Eigen::Vector3f& normal : surface.normals) {
    const Eigen::Vector3d placed = turn * normal.cast<double>();
    front_.push_back(normal_id(placed));
    if (both_sides) back_.push_back(normal_id(-placed));
  }
}

// The number of texture coordinates before those of the surface.
std::uint64_t ObjFile::texture_base(const Surface& surface) {
  const auto [place, is_new] = texture_bases_.try_emplace(&surface, texture_coordinates_);
  if (is_new) {
    for (const Eigen::Vector2f& uv : surface.texture_coordinates)
      put_numbers("vt", {uv.x(), uv.y()});
    texture_coordinates_ += surface.texture_coordinates.size();
  }
  return place->second;
}

// `texture` is 0 where there is none.
void ObjFile::put_corner(std::uint64_t vertex, std::uint64_t texture, std::uint32_t normal) {
  buffer_ += ' ';
  buffer_.append(NumberText(vertex));
  buffer_ += '/';
  if (texture != 0) buffer_.append(NumberText(texture));
  buffer_ += '/';
  buffer_.append(NumberText(normal));
}

void ObjFile::add(const Surface& surface, const Eigen::Affine3d& file_from_surface,
                  bool both_sides) {
  put_vertices(surface, file_from_surface);
  put_normals(surface, file_from_surface, both_sides);
  const bool textured = !surface.texture_coordinates.empty();
  const std::uint64_t uv = textured ? texture_base(surface) + 1 : 0;
  const auto put_face = [&](std::array<std::uint32_t, 3> corners,
                            const std::vector<std::uint32_t>& normals) {
    buffer_ += 'f';
    for (const std::uint32_t corner : corners)
      put_corner(vertices_ + corner + 1, textured ? uv + corner : 0, normals[corner]);
    buffer_ += '\n';
    ++triangles_;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    put_face({a, b, c}, front_);
    if (both_sides) put_face({c, b, a}, back_);
  }
  vertices_ += surface.vertices.size();
  if (buffer_.size() > kBuffer) flush();
}

void ObjFile::close() {
  flush();
  out_.close();
}

}  // namespace plotscan::gazebo
