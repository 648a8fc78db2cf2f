// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/shape_spec.h"

#include <cmath>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sdf/Visual.hh>

#include "core/error.h"

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
  throw InputError(world, "{} has a size that is not positive and finite", what);
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

ShapeSpec polyline(const sdf::ElementPtr& geometry, const std::string& what,
                   const fs::path& world) {
  ShapeSpec spec{.kind = ShapeKind::polyline, .loops = loops_of(geometry)};
  spec.length_m = geometry->GetElement("polyline")->Get<double>("height", 1.0).first;
  bool finite = std::isfinite(spec.length_m) && spec.length_m > 0;
  for (const auto& loop : spec.loops)
    for (const Eigen::Vector2d& point : loop) finite = finite && point.allFinite();
  if (!finite) throw InputError(world, "{} has a size that is not positive and finite", what);
  return spec;
}

ShapeSpec of_mesh(const sdf::Mesh& given, const std::string& what, const fs::path& world) {
  ShapeSpec spec{.kind = ShapeKind::mesh};
  spec.from = given.FilePath().empty() ? world : fs::path(given.FilePath());
  if (given.Uri().empty() || given.Uri() == kNoUri)
    throw InputError(spec.from, "{}: <mesh> has no <uri>", what);
  const Eigen::Vector3d scale = vector_of(given.Scale());
  if (!scale.allFinite() || (scale.array() == 0).any())
    throw InputError(spec.from, "{}: the mesh's scale has a number that is 0 or not finite", what);
  spec.uri = given.Uri();
  spec.submesh = given.Submesh();
  spec.centred = !given.Submesh().empty() && given.CenterSubmesh();
  spec.visual_from_mesh = scaling(scale);
  return spec;
}

std::optional<ShapeSpec> of_element(const sdf::Geometry& geometry, const std::string& what,
                                    const fs::path& world) {
  const sdf::ElementPtr element = geometry.Element();
  if (!element) return {};
  if (element->HasElement("polyline")) return polyline(element, what, world);
  if (element->HasElement("image"))
    throw InputError(world, "{}: <image> shapes are not read", what);
  return {};
}

ShapeSpec scaled(ShapeKind kind, const Eigen::Vector3d& sizes, const std::string& what,
                 const fs::path& world) {
  return {.kind = kind, .visual_from_mesh = scaling(positive(sizes, what, world))};
}

}  // namespace

std::optional<ShapeSpec> shape_spec(const sdf::Visual& visual, const std::string& what,
                                    const fs::path& world) {
  const sdf::Geometry& geometry = *visual.Geom();
  switch (geometry.Type()) {
    case sdf::GeometryType::MESH:
      return of_mesh(*geometry.MeshShape(), what, world);
    case sdf::GeometryType::BOX:
      return scaled(ShapeKind::box, vector_of(geometry.BoxShape()->Size()), what, world);
    case sdf::GeometryType::PLANE:
      return ShapeSpec{.kind = ShapeKind::plane,
                       .visual_from_mesh = plane_pose(*geometry.PlaneShape(), what, world)};
    case sdf::GeometryType::SPHERE:
      return scaled(ShapeKind::sphere, Eigen::Vector3d::Constant(geometry.SphereShape()->Radius()),
                    what, world);
    case sdf::GeometryType::ELLIPSOID:
      return scaled(ShapeKind::sphere, vector_of(geometry.EllipsoidShape()->Radii()), what, world);
    case sdf::GeometryType::CYLINDER: {
      const sdf::Cylinder& cylinder = *geometry.CylinderShape();
      return scaled(ShapeKind::cylinder, {cylinder.Radius(), cylinder.Radius(), cylinder.Length()},
                    what, world);
    }
    case sdf::GeometryType::CAPSULE: {
      const sdf::Capsule& given = *geometry.CapsuleShape();
      positive({given.Radius(), given.Length(), 1}, what, world);
      return ShapeSpec{
          .kind = ShapeKind::capsule, .radius_m = given.Radius(), .length_m = given.Length()};
    }
    case sdf::GeometryType::HEIGHTMAP:
      throw InputError(world, "{}: heightmaps are not read; give the ground as a mesh", what);
    default:
      return of_element(geometry, what, world);
  }
}

}  // namespace plotscan::gazebo
