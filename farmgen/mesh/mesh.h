// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace plotscan::mesh {

// An image as its file holds it.
struct Image {
  std::string name;   // a file name without folders: letters, digits, '-', '_', '.'
  std::string bytes;  // of a PNG or JPEG file

  bool operator==(const Image&) const = default;
};

class AlphaMask;  // mesh/alpha_mask.h

// How a surface looks; its name says what it is ("leaf", "stem", "ear").
struct Material {
  std::string name;                                          // may be empty: the file gave none
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(0.6F);  // diffuse red, green, blue in [0, 1]
  std::shared_ptr<const Image> texture = {};  // multiplied with the colour; null: none
  // Diffuse, at 903 nm, in [0, 1]; absent: not stated (mesh/reflectance.h).
  std::optional<float> reflectance = {};
  std::shared_ptr<const AlphaMask> mask = {};  // where the surface is there; null: everywhere
};
// True for the same name, colour, images and reflectance.
bool operator==(const Material& a, const Material& b);

// Triangles over shared vertices, metres, z up, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Material> materials = {};  // may be empty: all of one nameless material
  std::vector<std::uint16_t> triangle_material =
      {};  // index of each triangle's; empty: all have the first
  // (u, v) of each vertex, v upward from the image's lower edge; empty where no material has a
  // texture or a mask.
  std::vector<Eigen::Vector2f> texture_coordinates = {};

  std::uint16_t material_of(std::size_t triangle) const {
    return triangle_material.empty() ? std::uint16_t{0} : triangle_material[triangle];
  }
};

// The mesh without the vertices that no triangle names; the others in the order in which they are
// named first.
Mesh compact(const Mesh& mesh);

// The same surface with at most about `triangles` triangles. Each connected part of each material
// (a leaf, a stem) keeps its share of the triangles, its place, its texture and, by being widened a
// little, its area; the mesh keeps its extent and height. Where the triangles do not suffice for
// all parts, the smaller ones are left out, but never all. Returns the mesh itself where it has no
// more triangles than asked for.
Mesh simplified(const Mesh& mesh, std::size_t triangles);

}  // namespace plotscan::mesh
