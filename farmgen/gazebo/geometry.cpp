// SPDX-License-Identifier: Apache-2.0
#include "gazebo/geometry.h"

#include <algorithm>
#include <cmath>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "core/csv.h"
#include "core/error.h"
#include "gazebo/shapes.h"
#include "mesh/mesh_import.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

// What libsdformat puts for a <uri> that is not there.
constexpr const char* kNoUri = "__default__";

Eigen::Vector3d vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

// The sizes of a primitive, or an InputError.
Eigen::Vector3d positive(const Eigen::Vector3d& sizes, const std::string& what,
                         const fs::path& world) {
  if (sizes.allFinite() && sizes.minCoeff() > 0) return sizes;
  throw InputError(world, what + " has a size that is not positive and finite");
}

Eigen::Affine3d scaling(const Eigen::Vector3d& scale) {
  return Eigen::Affine3d(Eigen::Scaling(scale));
}

Eigen::Affine3d plane_pose(const sdf::Plane& plane, const std::string& what,
                           const fs::path& world) {
  const Eigen::Vector3d normal = vector_of(plane.Normal());
  const Eigen::Vector3d size =
      positive({plane.Size().X(), plane.Size().Y(), normal.norm()}, what, world);
  return Eigen::Affine3d(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal)) *
         Eigen::Scaling(Eigen::Vector3d(size.x(), size.y(), 1));
}

std::vector<std::vector<Eigen::Vector2d>> loops_of(const sdf::ElementPtr& geometry) {
  std::vector<std::vector<Eigen::Vector2d>> loops;
  for (sdf::ElementPtr loop = geometry->GetElement("polyline"); loop;
       loop = loop->GetNextElement("polyline")) {
    loops.emplace_back();
    if (!loop->HasElement("point")) continue;
    for (sdf::ElementPtr point = loop->GetElement("point"); point;
         point = point->GetNextElement("point")) {
      const auto place = point->Get<ignition::math::Vector2d>();
      loops.back().emplace_back(place.X(), place.Y());
    }
  }
  return loops;
}

std::string key_of(const std::string& kind, std::initializer_list<double> sizes) {
  std::string key = kind;
  for (const double size : sizes) key += ' ' + format_number(size);
  return key;
}

mesh::Mesh extruded_polyline(const sdf::ElementPtr& geometry, const std::string& what,
                             const fs::path& world) {
  const auto loops = loops_of(geometry);
  const auto height_m = geometry->GetElement("polyline")->Get<double>("height", 1.0).first;
  bool finite = std::isfinite(height_m) && height_m > 0;
  for (const auto& loop : loops)
    for (const Eigen::Vector2d& point : loop) finite = finite && point.allFinite();
  if (!finite) throw InputError(world, what + " has a size that is not positive and finite");
  try {
    return extruded(loops, height_m);
  } catch (const InputError& error) {
    throw InputError(world, what + ": " + error.what());
  }
}

mesh::Mesh imported(const fs::path& file, const std::string& object, const fs::path& from,
                    const std::string& what, std::vector<std::string>& notes) {
  try {
    return mesh::import_mesh(file, {.object = object}, &notes);
  } catch (const InputError& error) {
    throw InputError(from, what + ": mesh " + error.what());
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

Shape ShapeCache::of_mesh(const sdf::Mesh& given, const std::string& what) {
  const fs::path from = given.FilePath().empty() ? world_ : fs::path(given.FilePath());
  if (given.Uri().empty() || given.Uri() == kNoUri)
    throw InputError(from, what + ": <mesh> has no <uri>");
  const auto file = is_remote(given.Uri()) ? std::nullopt : finder_.find(given.Uri(), from);
  if (!file) throw InputError(from, what + ": mesh " + finder_.not_found(given.Uri(), from));
  const Eigen::Vector3d scale = vector_of(given.Scale());
  if (!scale.allFinite() || (scale.array() == 0).any())
    throw InputError(from, what + ": the mesh's scale has a number that is 0 or not finite");
  const std::string key =
      file->string() + '\n' + given.Submesh() + (given.CenterSubmesh() ? "\ncentred" : "");
  const std::uint32_t mesh = index(key, [&] {
    mesh::Mesh read = imported(*file, given.Submesh(), from, what, notes_);
    if (!given.Submesh().empty() && given.CenterSubmesh()) put_centre_at_origin(read);
    if (std::find(files_.begin(), files_.end(), *file) == files_.end()) files_.push_back(*file);
    return read;
  });
  return {.mesh = mesh, .visual_from_mesh = scaling(scale)};
}

std::optional<Shape> ShapeCache::of_element(const sdf::Geometry& geometry,
                                            const std::string& what) {
  const sdf::ElementPtr element = geometry.Element();
  if (!element) return {};
  if (element->HasElement("polyline")) {
    const std::uint32_t mesh =
        index("polyline of " + what, [&] { return extruded_polyline(element, what, world_); });
    return Shape{.mesh = mesh};
  }
  if (element->HasElement("image"))
    throw InputError(world_, what + ": <image> shapes are not read");
  return {};
}

std::optional<Shape> ShapeCache::of(const sdf::Visual& visual, const std::string& what) {
  const sdf::Geometry& geometry = *visual.Geom();
  switch (geometry.Type()) {
    case sdf::GeometryType::MESH:
      return of_mesh(*geometry.MeshShape(), what);
    case sdf::GeometryType::BOX:
      return Shape{index("box", unit_box),
                   scaling(positive(vector_of(geometry.BoxShape()->Size()), what, world_))};
    case sdf::GeometryType::PLANE:
      return Shape{index("plane", unit_plane), plane_pose(*geometry.PlaneShape(), what, world_)};
    case sdf::GeometryType::SPHERE: {
      const double radius_m = geometry.SphereShape()->Radius();
      return Shape{index("sphere", unit_sphere),
                   scaling(positive(Eigen::Vector3d::Constant(radius_m), what, world_))};
    }
    case sdf::GeometryType::ELLIPSOID:
      return Shape{index("sphere", unit_sphere),
                   scaling(positive(vector_of(geometry.EllipsoidShape()->Radii()), what, world_))};
    case sdf::GeometryType::CYLINDER: {
      const sdf::Cylinder& cylinder = *geometry.CylinderShape();
      const Eigen::Vector3d sizes(cylinder.Radius(), cylinder.Radius(), cylinder.Length());
      return Shape{index("cylinder", unit_cylinder), scaling(positive(sizes, what, world_))};
    }
    case sdf::GeometryType::CAPSULE: {
      const sdf::Capsule& given = *geometry.CapsuleShape();
      positive({given.Radius(), given.Length(), 1}, what, world_);
      const auto make = [&] { return capsule(given.Radius(), given.Length()); };
      return Shape{index(key_of("capsule", {given.Radius(), given.Length()}), make),
                   Eigen::Affine3d::Identity()};
    }
    case sdf::GeometryType::HEIGHTMAP:
      throw InputError(world_, what + ": heightmaps are not read; give the ground as a mesh");
    default:
      return of_element(geometry, what);
  }
}

}  // namespace plotscan::gazebo
