// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/shape_cache.h"

#include <fmt/core.h>

#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "gazebo/internal/primitive_meshes.h"
#include "mesh/mesh_import.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

mesh::Mesh imported(const fs::path& file, const std::string& object, const fs::path& from,
                    const std::string& what, std::vector<std::string>& notes) {
  try {
    return mesh::import_mesh(file, {.object = object}, &notes);
  } catch (const InputError& error) {
    throw InputError(from, "{}: mesh {}", what, error.what());
  }
}

}  // namespace

template <class Make>
std::uint32_t ShapeCache::index(const std::string& key, Make&& make) {
  const auto [place, is_new] = index_.try_emplace(key, static_cast<std::uint32_t>(meshes_.size()));
  if (is_new) {
    meshes_.push_back(make());
    bounds_.emplace_back();
    for (const Eigen::Vector3f& v : meshes_.back().vertices)
      bounds_.back().extend(v.cast<double>());
  }
  return place->second;
}

std::uint32_t ShapeCache::of_mesh(const ShapeSpec& given, const std::string& what) {
  const auto file = finder_.find(given.uri, given.from);
  if (!file)
    throw InputError(given.from, "{}: mesh {}", what, finder_.not_found(given.uri, given.from));
  const std::string key =
      file->string() + '\n' + given.submesh + (given.centred ? "\ncentred" : "");
  return index(key, [&] {
    mesh::Mesh read = imported(*file, given.submesh, given.from, what, notes_);
    if (given.centred) put_centre_at_origin(read);
    if (!contains(files_, *file)) files_.push_back(*file);
    return read;
  });
}

std::uint32_t ShapeCache::of_polyline(const ShapeSpec& given, const std::string& what) {
  return index("polyline of " + what, [&] {
    try {
      return extruded(given.loops, given.length_m);
    } catch (const InputError& error) {
      throw InputError(world_, "{}: {}", what, error.what());
    }
  });
}

std::uint32_t ShapeCache::of(const ShapeSpec& given, const std::string& what) {
  switch (given.kind) {
    case ShapeKind::mesh:
      return of_mesh(given, what);
    case ShapeKind::box:
      return index("box", unit_box);
    case ShapeKind::plane:
      return index("plane", unit_plane);
    case ShapeKind::sphere:
      return index("sphere", unit_sphere);
    case ShapeKind::cylinder:
      return index("cylinder", unit_cylinder);
    case ShapeKind::capsule:
      return index(fmt::format("capsule {} {}", format_number(given.radius_m),
                               format_number(given.length_m)),
                   [&] { return capsule(given.radius_m, given.length_m); });
    default:
      return of_polyline(given, what);
  }
}

}  // namespace plotscan::gazebo
