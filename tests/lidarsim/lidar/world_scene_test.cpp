// SPDX-License-Identifier: Apache-2.0
// Rays on the primitives of a world written by hand, against closed forms.
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "core/random.h"
#include "farmgen/gazebo/world_text.h"
#include "gazebo/read_world.h"
#include "lidar/scene.h"
#include "lidar/site.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

using Eigen::Vector3d;
using testing::model_text;
using testing::TemporaryFolder;
using testing::visual_text;
using testing::world_text;

// The distance along a ray, in the shape's frame, to where it enters; absent: it misses.
using Closed = std::function<std::optional<double>(const Vector3d& origin, const Vector3d& ray)>;

std::optional<double> nearest(std::initializer_list<std::optional<double>> hits) {
  std::optional<double> least;
  for (const auto& hit : hits) {
    if (hit && *hit >= 0 && (!least || *hit < *least)) least = hit;
  }
  return least;
}

// Of |p / radii| = 1.
std::optional<double> to_ellipsoid(const Vector3d& origin, const Vector3d& ray,
                                   const Vector3d& radii) {
  const Vector3d o = origin.cwiseQuotient(radii);
  const Vector3d d = ray.cwiseQuotient(radii);
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double root = b * b - a * (o.squaredNorm() - 1);
  if (root < 0) return {};
  return (-b - std::sqrt(root)) / a;
}

std::optional<double> to_box(const Vector3d& origin, const Vector3d& ray, const Vector3d& sizes) {
  double enter = -1e9;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = (-sizes[axis] / 2 - origin[axis]) / ray[axis];
    const double other = (sizes[axis] / 2 - origin[axis]) / ray[axis];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  if (enter > leave) return {};
  return enter;
}

std::optional<double> to_tube(const Vector3d& origin, const Vector3d& ray, double radius,
                              double length) {
  const Eigen::Vector2d o = origin.head<2>();
  const Eigen::Vector2d d = ray.head<2>();
  const double root = std::pow(o.dot(d), 2) - d.squaredNorm() * (o.squaredNorm() - radius * radius);
  if (root < 0) return {};
  const double range = (-o.dot(d) - std::sqrt(root)) / d.squaredNorm();
  if (std::abs(origin.z() + range * ray.z()) > length / 2) return {};
  return range;
}

// Of the disc or rectangle where `inside` holds, at height z.
std::optional<double> to_sheet(const Vector3d& origin, const Vector3d& ray, double z,
                               const std::function<bool(double, double)>& inside) {
  const double range = (z - origin.z()) / ray.z();
  const Vector3d place = origin + range * ray;
  if (range < 0 || !inside(place.x(), place.y())) return {};
  return range;
}

struct Primitive {
  const char* name;
  const char* sdf;
  Closed closed;
  double radius_m;  // round ones: their triangles lie up to 8e-5 of it inside
};

void PrintTo(const Primitive& primitive, std::ostream* out) { *out << primitive.name; }

std::vector<Primitive> primitives() {
  const auto in_disc = [](double x, double y) { return std::hypot(x, y) <= 0.5; };
  const auto in_plane = [](double x, double y) { return std::abs(x) <= 1 && std::abs(y) <= 0.75; };
  // An L: the square of side 2 without its upper right quarter.
  const auto in_l = [](double x, double y) {
    return x >= 0 && y >= 0 && x <= 2 && y <= 2 && !(x > 1 && y > 1);
  };
  return {
      {"Box", "<box><size>1 2 0.5</size></box>",
       [](const Vector3d& o, const Vector3d& d) {
         return to_box(o, d, {1, 2, 0.5});
       },
       0},
      {"Sphere", "<sphere><radius>0.8</radius></sphere>",
       [](const Vector3d& o, const Vector3d& d) {
         return to_ellipsoid(o, d, Vector3d::Constant(0.8));
       },
       0.8},
      {"Ellipsoid", "<ellipsoid><radii>0.5 0.9 0.3</radii></ellipsoid>",
       [](const Vector3d& o, const Vector3d& d) {
         return to_ellipsoid(o, d, {0.5, 0.9, 0.3});
       },
       0.9},
      {"Cylinder", "<cylinder><radius>0.5</radius><length>1.4</length></cylinder>",
       [=](const Vector3d& o, const Vector3d& d) {
         return nearest({to_tube(o, d, 0.5, 1.4), to_sheet(o, d, 0.7, in_disc),
                         to_sheet(o, d, -0.7, in_disc)});
       },
       0.5},
      {"Capsule", "<capsule><radius>0.4</radius><length>1</length></capsule>",
       [](const Vector3d& o, const Vector3d& d) {
         const auto end = [&](double z) {
           return to_ellipsoid(o - Vector3d(0, 0, z), d, Vector3d::Constant(0.4));
         };
         return nearest({to_tube(o, d, 0.4, 1), end(0.5), end(-0.5)});
       },
       0.4},
      {"Plane", "<plane><normal>0 0 1</normal><size>2 1.5</size></plane>",
       [=](const Vector3d& o, const Vector3d& d) { return to_sheet(o, d, 0, in_plane); }, 0},
      {"PlaneOnEdge", "<plane><normal>1 0 0</normal><size>2 1.5</size></plane>",
       [=](const Vector3d& o, const Vector3d& d) {
         // z of the plane's own frame is x here, its x is -z.
         const auto turned = [](const Vector3d& v) { return Vector3d(-v.z(), v.y(), v.x()); };
         return to_sheet(turned(o), turned(d), 0, in_plane);
       },
       0},
      {"Polyline",
       "<polyline><point>0 0</point><point>2 0</point><point>2 1</point><point>1 1</point>"
       "<point>1 2</point><point>0 2</point><height>0.5</height></polyline>",
       [=](const Vector3d& o, const Vector3d& d) {
         const auto wall = [&](const Vector3d& center, const Vector3d& sizes) {
           return to_box(o - center, d, sizes);
         };
         return nearest({wall({1, 0.5, 0.25}, {2, 1, 0.5}), wall({0.5, 1, 0.25}, {1, 2, 0.5}),
                         to_sheet(o, d, 0.5, in_l)});
       },
       0},
  };
}

class RangesOn : public ::testing::TestWithParam<Primitive> {};

// Rays from all around at a primitive that is moved and turned. Near its outline a ray may decide
// otherwise: there a shape a little larger is met and one a little smaller is not.
TEST_P(RangesOn, PrimitivesAreThoseOfClosedForms) {
  const TemporaryFolder folder;
  const gazebo::StaticWorld world = gazebo::read_world(folder.write(
      "w.sdf", world_text(model_text("m", "3 -2 1.5 0.4 -0.3 0.9", visual_text(GetParam().sdf)))));
  const Scene scene(scene_content(world));
  const Eigen::Isometry3d world_from_shape =
      Eigen::Translation3d(3, -2, 1.5) * Eigen::AngleAxisd(0.9, Vector3d::UnitZ()) *
      Eigen::AngleAxisd(-0.3, Vector3d::UnitY()) * Eigen::AngleAxisd(0.4, Vector3d::UnitX());
  int hits = 0;
  int otherwise = 0;
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    RandomStream stream(5, random_purpose("test/ray"), static_cast<std::uint64_t>(i));
    const auto around = [&](double reach) {
      return Vector3d(stream.uniform(-reach, reach), stream.uniform(-reach, reach),
                      stream.uniform(-reach, reach));
    };
    const Vector3d origin = 6 * (around(1) + Vector3d(1e-3, 0, 0)).normalized();
    const Vector3d direction = (around(1) + Vector3d(0.3, 0.3, 0) - origin).normalized();
    const auto expected = GetParam().closed(origin, direction);
    const Ray ray{(world_from_shape * origin).cast<float>(),
                  (world_from_shape.linear() * direction).cast<float>()};
    Hit hit;
    scene.cast({&ray, 1}, 100, {&hit, 1});
    hits += expected ? 1 : 0;
    // A ray that grazes a round surface under the angle of incidence a enters its triangles later
    // by their depth over cos a.
    const double depth =
        1e-5 + 8e-5 * GetParam().radius_m / std::max(0.05, static_cast<double>(hit.cos_incidence));
    const bool same = expected && std::isfinite(hit.range_m)
                          ? std::abs(hit.range_m - *expected) < depth
                          : expected.has_value() == std::isfinite(hit.range_m);
    otherwise += same ? 0 : 1;
  }
  EXPECT_GT(hits, kRays / 50);
  EXPECT_LE(otherwise, kRays / 1000) << "only at the outline";
}

INSTANTIATE_TEST_SUITE_P(Worlds, RangesOn, ::testing::ValuesIn(primitives()),
                         [](const auto& tested) { return tested.param.name; });

TEST(WorldScene, SurfacesKeepTheirClassPlotAndPlant) {
  const TemporaryFolder folder;
  const std::string box = "<box><size>1 1 1</size></box>";
  const gazebo::StaticWorld world = gazebo::read_world(folder.write(
      "w.sdf", world_text(model_text("ground_plane", "0 0 0 0 0 0",
                                     visual_text("<plane><size>50 50</size></plane>")) +
                          model_text("plot_3", "4 0 0.5 0 0 0",
                                     visual_text(box, "<laser_retro>3</laser_retro>", "plant_8")) +
                          model_text("shed", "-4 0 0.5 0 0 0", visual_text(box)))));
  const SceneContent content = scene_content(world);
  const Scene scene(content);
  const auto under = [&](float x) {
    const Ray ray{{x, 0.1F, 5}, {0, 0, -1}};
    Hit hit;
    scene.cast({&ray, 1}, 100, {&hit, 1});
    return scene.surface(hit);
  };
  EXPECT_EQ(under(0).label, scan::PointClass::ground);
  EXPECT_EQ(under(4).label, scan::PointClass::weed);
  EXPECT_EQ(under(4).plot, 3u);
  EXPECT_EQ(under(4).plant, 8u);
  EXPECT_EQ(under(-4).label, scan::PointClass::other);
  const Site site = site_of(world.name, content);
  EXPECT_TRUE(site.areas.at(0).center.isApprox(Eigen::Vector2d(4, 0)));
  EXPECT_NEAR(site.ground_m.value(), 0, 1e-6);
}

}  // namespace
}  // namespace plotscan::lidar
