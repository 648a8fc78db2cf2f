// SPDX-License-Identifier: Apache-2.0
#include "crop/plant_builder.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "mesh/measure.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;
using mesh::Mesh;

constexpr Detail kBoth[] = {Detail::scan, Detail::light};

PlantBuilder builder(Detail detail) {
  return {detail, {{"leaf", {0.2F, 0.5F, 0.1F}}, {"stem", {0.4F, 0.5F, 0.2F}}}};
}

Blade arch() {
  Blade blade{.midrib = {},
              .half_width_m = {},
              .across = {Vector3d::UnitY()},
              .fold_rad = 0.3,
              .light_points = 4};
  for (int i = 0; i <= 12; ++i) {
    const double share = i / 12.0;
    blade.midrib.emplace_back(0.5 * share, 0, 0.4 * std::sin(std::numbers::pi * 0.7 * share));
    blade.half_width_m.push_back(i == 12 ? 0 : 0.02 * (1 - share * share));
  }
  return blade;
}

// Volume inside the surface (divergence theorem): positive when triangles face outward.
double volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d p = mesh.vertices[a].cast<double>();
    six += p.dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  }
  return six / 6;
}

TEST(PlantBuilder, AClosedTubeHoldsTheVolumeOfItsPrism) {
  PlantBuilder plant = builder(Detail::scan);
  plant.tube({.path = {{0, 0, 0}, {0, 0, 0.1}, {0, 0, 0.2}},
              .radius_m = {0, 0.01, 0.01},
              .sides = 8,
              .closed_tip = true},
             "stem");
  // A cone and a prism over a regular octagon.
  const double octagon = 8 * 0.5 * 0.01 * 0.01 * std::sin(2 * std::numbers::pi / 8);
  EXPECT_NEAR(volume(plant.take()), octagon * (0.1 + 0.1 / 3), 1e-3 * octagon);
}

// A leaflet without a stalk (rachis_share 0) had one whose corners were no numbers.
TEST(PlantBuilder, ATubeOfNoLengthIsLeftOut) {
  PlantBuilder plant = builder(Detail::scan);
  plant.tube({.path = {{0, 0, 0.1}, {0, 0, 0.1}}, .radius_m = {0.01, 0.007}}, "stem");
  EXPECT_TRUE(plant.take().vertices.empty());
}

TEST(PlantBuilder, AnEllipsoidFacesOutwardAndKeepsItsHalfAxes) {
  PlantBuilder plant = builder(Detail::scan);
  plant.ellipsoid({0, 0, 1}, Vector3d::UnitX(), Vector3d::UnitY(), {0.03, 0.02, 0.01}, "stem");
  const Mesh mesh = plant.take();
  Eigen::AlignedBox3f box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex);
  EXPECT_NEAR(box.sizes().x(), 0.06, 1e-5);
  EXPECT_NEAR(box.sizes().y(), 0.04, 1e-5);
  EXPECT_NEAR(box.sizes().z(), 0.02 * std::sin(std::numbers::pi / 3), 2e-5);
  const double whole = 4.0 / 3 * std::numbers::pi * 0.03 * 0.02 * 0.01;
  EXPECT_GT(volume(mesh), 0.5 * whole);
  EXPECT_LT(volume(mesh), whole);
}

TEST(PlantBuilder, ATubeFollowsItsPathWithoutTurning) {
  Tube bent{.path = {}, .radius_m = {}, .sides = 6};
  for (int i = 0; i <= 40; ++i) {
    const double angle = i * 0.1;
    bent.path.emplace_back(std::cos(angle), std::sin(angle), 0.1 * angle);
    bent.radius_m.push_back(0.05);
  }
  PlantBuilder plant = builder(Detail::scan);
  plant.tube(bent, "stem");
  const Mesh mesh = plant.take();
  const Vector3d step = bent.path[1] - bent.path[0];
  double longest = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    longest = std::max(longest, static_cast<double>((mesh.vertices[b] - mesh.vertices[c]).norm()));
  }
  EXPECT_LT(longest, 1.2 * step.norm()) << "no ring is turned against the last";
}

TEST(PlantBuilder, ABladeKeepsItsAreaInLightDetail) {
  const Blade blade = arch();
  double outline = 0;
  for (std::size_t i = 1; i < blade.midrib.size(); ++i) {
    outline += (blade.midrib[i] - blade.midrib[i - 1]).norm() *
               (blade.half_width_m[i] + blade.half_width_m[i - 1]);
  }
  for (const Detail detail : kBoth) {
    PlantBuilder plant = builder(detail);
    plant.blade(blade, "leaf");
    const Mesh mesh = plant.take();
    EXPECT_NEAR(mesh::ScaledArea(mesh).at(), outline, 0.03 * outline);
    EXPECT_EQ(mesh.triangles.size(), detail == Detail::scan ? 11 * 4 + 2 : 5);
  }
}

TEST(PlantBuilder, ABladeFacesUpFromLeftToRightAndFoldsUpward) {
  Blade flat{.midrib = {{0, 0, 0}, {1, 0, 0}},
             .half_width_m = {0.1, 0.1},
             .across = {Vector3d::UnitY()},
             .fold_rad = std::numbers::pi / 6};
  for (const Detail detail : kBoth) {
    PlantBuilder plant = builder(detail);
    plant.blade(flat, "leaf");
    const Mesh mesh = plant.take(true);
    ASSERT_FALSE(mesh.triangles.empty());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3f ab = mesh.vertices[b] - mesh.vertices[a];
      EXPECT_GT(ab.cross(mesh.vertices[c] - mesh.vertices[a]).z(), 0);
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Eigen::Vector2f& uv = mesh.texture_coordinates[i];
      EXPECT_NEAR(uv.y(), mesh.vertices[i].x(), 1e-4);
      EXPECT_EQ(mesh.vertices[i].y() > 0, uv.x() < 0.5F);
      if (detail == Detail::scan && uv.x() != 0.5F) {
        EXPECT_NEAR(mesh.vertices[i].z(), 0.05, 1e-5);
      }
    }
  }
}

TEST(PlantBuilder, CoordinatesAreWholeHundredthsOfAMillimetre) {
  PlantBuilder plant = builder(Detail::scan);
  plant.blade(arch(), "leaf");
  plant.tube({.path = {{0, 0, 0}, {0.012345678, 0, 0.3}}, .radius_m = {0.002, 0.001}}, "stem");
  const Mesh mesh = plant.take();
  EXPECT_TRUE(mesh.texture_coordinates.empty());
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[1].name, "stem");
  for (const auto& vertex : mesh.vertices) {
    const Vector3d cells = vertex.cast<double>() * 1e5;
    EXPECT_LT((cells.array() - cells.array().round()).abs().maxCoeff(), 0.01);
  }
}

}  // namespace
}  // namespace plotscan::crop
