// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "core/bytes.h"
#include "gazebo/internal/load_world.h"

namespace plotscan::gazebo {
namespace {

void put_affine(ByteWriter& bytes, const Eigen::Affine3d& transform) {
  for (const double number : transform.matrix().reshaped()) bytes.put(number);
}

Eigen::Affine3d get_affine(ByteReader& bytes) {
  Eigen::Affine3d transform;
  for (double& number : transform.matrix().reshaped()) number = bytes.get<double>();
  if (!transform.matrix().allFinite()) throw std::runtime_error("a pose was handed over broken");
  return transform;
}

template <class Choice>
Choice get_choice(ByteReader& bytes, Choice last) {
  const auto value = bytes.get<Choice>();
  if (value > last) throw std::runtime_error("a kind was handed over broken");
  return value;
}

void put_shape(ByteWriter& bytes, const ShapeSpec& shape) {
  bytes.put(shape.kind);
  put_affine(bytes, shape.visual_from_mesh);
  bytes.put(shape.radius_m);
  bytes.put(shape.length_m);
  bytes.put(static_cast<std::uint64_t>(shape.loops.size()));
  for (const auto& loop : shape.loops) bytes.put_list(loop);
  bytes.put_text(shape.uri);
  bytes.put_text(shape.from.string());
  bytes.put_text(shape.submesh);
  bytes.put(shape.centred);
}

ShapeSpec get_shape(ByteReader& bytes) {
  ShapeSpec shape{.kind = get_choice(bytes, ShapeKind::polyline)};
  shape.visual_from_mesh = get_affine(bytes);
  shape.radius_m = bytes.get<double>();
  shape.length_m = bytes.get<double>();
  for (auto left = bytes.get<std::uint64_t>(); left > 0; --left)
    shape.loops.push_back(bytes.get_list<Eigen::Vector2d>());
  shape.uri = bytes.get_text();
  shape.from = bytes.get_text();
  shape.submesh = bytes.get_text();
  shape.centred = bytes.get<bool>();
  return shape;
}

void put_visual(ByteWriter& bytes, const PlacedVisual& visual) {
  put_shape(bytes, visual.shape);
  put_affine(bytes, visual.world_from_visual);
  bytes.put(visual.kind);
  bytes.put(visual.plot);
  bytes.put(visual.plant);
  bytes.put_text(visual.what);
}

PlacedVisual get_visual(ByteReader& bytes) {
  PlacedVisual visual{.shape = get_shape(bytes), .what = {}};
  visual.world_from_visual = get_affine(bytes);
  visual.kind = get_choice(bytes, farm::SurfaceClass::other);
  visual.plot = bytes.get<std::uint32_t>();
  visual.plant = bytes.get<std::uint32_t>();
  visual.what = bytes.get_text();
  return visual;
}

}  // namespace

std::string bytes_of(const WorldVisuals& world) {
  ByteWriter bytes;
  bytes.put_text(world.name);
  bytes.put(static_cast<std::uint64_t>(world.visuals.size()));
  for (const PlacedVisual& visual : world.visuals) put_visual(bytes, visual);
  bytes.put(static_cast<std::uint64_t>(world.notes.size()));
  for (const std::string& note : world.notes) bytes.put_text(note);
  return bytes.take();
}

WorldVisuals world_visuals_of(std::string_view text) {
  ByteReader bytes(text);
  WorldVisuals world{.name = bytes.get_text(), .visuals = {}, .notes = {}};
  for (auto left = bytes.get<std::uint64_t>(); left > 0; --left)
    world.visuals.push_back(get_visual(bytes));
  for (auto left = bytes.get<std::uint64_t>(); left > 0; --left)
    world.notes.push_back(bytes.get_text());
  return world;
}

}  // namespace plotscan::gazebo
