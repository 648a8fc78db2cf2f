// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <complex>

#include <gtest/gtest.h>

#include "crop/grow.h"
#include "farmgen/crop/mesh_parts.h"
#include "mesh/measure.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3f;
using mesh::Mesh;
using plotscan::testing::axial_mean;
using plotscan::testing::highest;
using plotscan::testing::lowest;
using plotscan::testing::vertices_of;

constexpr std::size_t kSpindleTriangles = 6;  // of an ear in light detail

Mesh wheat(const std::string& stage, std::uint64_t seed, std::vector<std::string> assignments = {},
           Detail detail = Detail::scan) {
  return grow({.crop = "wheat",
               .stage = stage,
               .assignments = std::move(assignments),
               .detail = detail,
               .cultivar_file = {}},
              seed);
}

std::size_t ears_of(const std::string& stage, std::uint64_t seed,
                    std::vector<std::string> assignments) {
  const Mesh light = wheat(stage, seed, std::move(assignments), Detail::light);
  return vertices_of(light, "ear").size() / 3 / kSpindleTriangles;
}

TEST(Wheat, EarsAreTheTopAndCarryAwns) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Mesh tuft = wheat("Z65", seed, {"tuft_m=0.25"});
    const float ears = highest(vertices_of(tuft, "ear"));
    EXPECT_GT(ears, highest(vertices_of(tuft, "leaf"))) << seed;
    EXPECT_FLOAT_EQ(highest(vertices_of(tuft, "awn")), static_cast<float>(mesh_height(tuft)));
    EXPECT_GT(highest(vertices_of(tuft, "awn")), ears + 0.03F) << seed;
    EXPECT_GT(ears, 0.7F) << seed;
    EXPECT_LT(ears, 1.0F) << seed;
  }
  EXPECT_TRUE(vertices_of(wheat("Z65", 1, {"awn_m=0"}), "awn").empty());
}

TEST(Wheat, EarsShowFromHeadingAndRipen) {
  for (const std::string& stage : stages("wheat")) {
    for (const Detail detail : {Detail::scan, Detail::light}) {
      const Mesh mesh = wheat(stage, 2, {"tuft_m=0.25"}, detail);
      const bool headed = stage >= "Z55";
      EXPECT_EQ(!vertices_of(mesh, "awn").empty(), headed) << stage;
      EXPECT_EQ(!vertices_of(mesh, "ear").empty(), headed && stage < "Z85") << stage;
      EXPECT_EQ(!vertices_of(mesh, "ripe_ear").empty(), stage == "Z85") << stage;
    }
  }
}

// At Zadoks 55 half of the ear is out of the flag leaf's sheath, at 59 all of it.
TEST(Wheat, TheEarEmergesFromItsSheath) {
  const auto shown_m = [](const std::string& stage) {
    const auto ear =
        vertices_of(wheat(stage, 1, {"tillers=0", "lean_deg=0", "ear_nod_deg=0"}), "ear");
    return highest(ear) - lowest(ear);
  };
  EXPECT_NEAR(shown_m("Z55") / shown_m("Z65"), 0.5, 0.15);
  EXPECT_NEAR(shown_m("Z59") / shown_m("Z65"), 1, 0.02);
}

TEST(Wheat, SpikeletsStandInTwoRows) {
  std::vector<Vector3f> ear =
      vertices_of(wheat("Z65", 3, {"tillers=0", "lean_deg=0", "ear_nod_deg=0"}), "ear");
  Vector3f middle = Vector3f::Zero();
  for (const Vector3f& vertex : ear) middle += vertex / static_cast<float>(ear.size());
  for (Vector3f& vertex : ear) vertex -= middle;
  EXPECT_GT(std::abs(axial_mean(ear)), 0.3) << "about 0 were they all around the rachis";
}

TEST(Wheat, RipeEarsNod) {
  const auto awns_hang = [](const std::string& nod) {
    const Mesh shoot = wheat("Z65", 5, {"tillers=0", nod});
    return lowest(vertices_of(shoot, "awn")) < lowest(vertices_of(shoot, "ear"));
  };
  EXPECT_TRUE(awns_hang("ear_nod_deg=160"));
  EXPECT_FALSE(awns_hang("ear_nod_deg=0"));
  EXPECT_GT(mesh_height(wheat("Z85", 5, {"ear_nod_deg=0"})), mesh_height(wheat("Z85", 5)));
}

TEST(Wheat, PlantsHaveTheMeanNumberOfTillers) {
  for (const double tillers : {0.0, 1.0, 3.0}) {
    double shoots = 0;
    constexpr int kGrown = 150;
    for (std::uint64_t seed = 1; seed <= kGrown; ++seed) {
      shoots += static_cast<double>(ears_of("Z65", seed, {"tillers=" + std::to_string(tillers)}));
    }
    // One standard error of the mean is 0.07: a plant's number is within 2 of the mean.
    EXPECT_NEAR(shoots / kGrown, 1 + tillers, 0.2) << tillers;
  }
}

TEST(Wheat, ATuftHasTheDefaultPlotsPlantsAlongItsRow) {
  const Cultivar described = cultivar("wheat");
  const Traits traits(described, described.stage(""), {});
  const double per_m = described.plants_per_m2 * described.row_spacing_m;
  EXPECT_DOUBLE_EQ(traits["tuft_plants_per_m"], per_m);
  for (const double tuft_m : {0.25, 0.5}) {
    const std::vector<std::string> assignments = {"tillers=0", "tuft_m=" + std::to_string(tuft_m)};
    EXPECT_EQ(ears_of("Z65", 1, assignments), std::lround(tuft_m * per_m)) << tuft_m;
    const Mesh tuft = wheat("Z65", 1, assignments);
    float first = 0;
    float last = 0;
    for (const Vector3f& vertex : vertices_of(tuft, "stem")) {
      if (vertex.z() > 1e-3F) continue;  // the shoots' feet
      first = std::min(first, vertex.x());
      last = std::max(last, vertex.x());
    }
    EXPECT_GT(first, -tuft_m / 2 - 0.005);
    EXPECT_LT(last, tuft_m / 2 + 0.005);
    EXPECT_GT(last - first, 0.7 * tuft_m);
  }
}

TEST(Wheat, StaysOnTheGroundAndWithinItsTriangles) {
  for (const std::string& stage : stages("wheat")) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Mesh plant = wheat(stage, seed);
      EXPECT_LE(plant.triangles.size(), 4000u) << stage;
      EXPECT_LE(wheat(stage, seed, {}, Detail::light).triangles.size(), 300u) << stage;
      const std::vector<std::string> tuft = {"tuft_m=0.25"};
      EXPECT_LE(wheat(stage, seed, tuft).triangles.size(), 12000u) << stage;
      EXPECT_LE(wheat(stage, seed, tuft, Detail::light).triangles.size(), 400u) << stage;
      EXPECT_GT(lowest(plant.vertices), -0.003F) << stage << ": the foot of a leaning shoot";
    }
  }
}

TEST(Wheat, ParametersDoWhatTheySay) {
  const auto ear_foot = [](const std::string& assignment) {
    return lowest(vertices_of(
        wheat("Z65", 1, {assignment, "tillers=0", "lean_deg=0", "plant_variation=0"}), "ear"));
  };
  EXPECT_NEAR(ear_foot("stem_m=0.9"), 0.9, 0.02);
  EXPECT_NEAR(ear_foot("stem_m=0.6"), 0.6, 0.02);
  const auto area = [](const std::string& assignment) {
    return mesh::ScaledArea::of_leaves(wheat("Z39", 1, {assignment})).at();
  };
  EXPECT_NEAR(area("blade_width_m=0.02") / area("blade_width_m=0.01"), 2, 0.05);
  EXPECT_GT(area("green_leaves=5"), area("green_leaves=3"));
  const auto width = [](const std::string& assignment) {
    double widest = 0;
    for (const Vector3f& vertex : vertices_of(wheat("Z25", 1, {assignment}), "stem")) {
      widest = std::max<double>(widest, vertex.head<2>().norm());
    }
    return widest;
  };
  EXPECT_GT(width("tiller_angle_deg=70"), width("tiller_angle_deg=10") + 0.02);
}

}  // namespace
}  // namespace plotscan::crop
