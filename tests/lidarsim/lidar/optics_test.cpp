// SPDX-License-Identifier: Apache-2.0
// Reflectances and masks of materials as a laser meets them, against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>

#include "lidar/scene.h"
#include "lidar/simulate.h"
#include "mesh/alpha_mask.h"
#include "mesh/mesh_import.h"
#include "mesh/reflectance.h"
#include "small_farm.h"
#include "temporary_folder.h"
#include "test_images.h"

namespace plotscan::lidar {
namespace {

using plotscan::testing::png_of_grey;

constexpr double kSide_m = 2;

std::shared_ptr<const mesh::AlphaMask> mask_of(const std::string& bytes) {
  return std::make_shared<const mesh::AlphaMask>(
      std::make_shared<const mesh::Image>(mesh::Image{"mask.png", bytes}), mesh::kAlphaCutoff,
      "mask.png");
}

// A square of kSide_m about the origin in the plane z = 0; its texture is repeated so often.
mesh::Mesh square(const mesh::Material& material, float repeats = 1) {
  const float s = kSide_m / 2;
  const float r = repeats;
  return {.vertices = {{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .materials = {material},
          .triangle_material = {0, 0},
          .texture_coordinates = {{0, 0}, {r, 0}, {r, r}, {0, r}}};
}

// A farm of soil alone, with the mesh as its one plant.
farm::Farm farm_with(const mesh::Mesh& mesh, const Eigen::Vector3d& scale, double lean_rad) {
  farm::Farm farm{.name = "one",
                  .terrain = testing::flat_terrain(10, -1),
                  .models = {{.name = "square", .mesh = mesh, .height_m = 1}},
                  .plots = {},
                  .plants = {}};
  farm.plants.push_back(
      {.id = 1,
       .position = {0.3, -0.2, 2},
       .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(lean_rad, Eigen::Vector3d::UnitX())),
       .scale = scale});
  return farm;
}

// Hits of rays on a grid over the plant's square, along its normal.
std::vector<Hit> hits_over(const farm::Farm& farm, int rays_a_side) {
  const farm::Plant& plant = farm.plants.at(0);
  std::vector<Ray> rays;
  for (int i = 0; i < rays_a_side; ++i) {
    for (int k = 0; k < rays_a_side; ++k) {
      const auto place = [&](int n) { return kSide_m * ((n + 0.5) / rays_a_side - 0.5); };
      const Eigen::Vector3d local(place(i), place(k), 0);
      const Eigen::Vector3d up = plant.rotation * Eigen::Vector3d::UnitZ();
      const Eigen::Vector3d origin =
          plant.position + plant.rotation * local.cwiseProduct(plant.scale) + 1.5 * up;
      rays.push_back({origin.cast<float>(), (-up).cast<float>()});
    }
  }
  std::vector<Hit> hits(rays.size());
  Scene(scene_content(farm)).cast(rays, 1000, hits);
  return hits;
}

// Of the rays, those that meet the square.
double share_stopped(const std::vector<Hit>& hits) {
  const auto stopped = std::count_if(
      hits.begin(), hits.end(), [](const Hit& hit) { return std::abs(hit.range_m - 1.5F) < 1e-3; });
  return static_cast<double>(stopped) / static_cast<double>(hits.size());
}

TEST(Optics, AFacingPlaneOfAMaterialReturnsItsReflectance) {
  for (const char* name : {"leaf", "stem", "ear", "dry"}) {
    const float reflectance = *mesh::reflectance_by_name(name);
    for (const Hit& hit : hits_over(farm_with(square({.name = name}), {1, 1, 1}, 0), 20)) {
      ASSERT_EQ(hit.reflectance, reflectance);
      ASSERT_EQ(return_intensity(hit.reflectance, hit.cos_incidence),
                std::round(100 * reflectance));
    }
  }
  const mesh::Mesh stated = square({.name = "leaf", .reflectance = 0.62F});
  for (const Hit& hit : hits_over(farm_with(stated, {1, 1, 1}, 0), 20))
    ASSERT_EQ(return_intensity(hit.reflectance, hit.cos_incidence), 62);
}

TEST(Optics, EachTriangleHasItsMaterialsReflectance) {
  mesh::Mesh two = square({.name = "leaf"});
  two.materials.push_back({.name = "stem"});
  two.triangle_material = {0, 1};
  const std::vector<Hit> hits = hits_over(farm_with(two, {1, 1, 1}, 0.4), 100);
  int leaf = 0;
  int stem = 0;
  for (const Hit& hit : hits) {
    leaf += hit.reflectance == 0.45F ? 1 : 0;
    stem += hit.reflectance == 0.40F ? 1 : 0;
  }
  EXPECT_EQ(leaf + stem, 100 * 100);
  EXPECT_NEAR(leaf, 50 * 100, 100) << "the diagonal's rays go either way";
}

TEST(Optics, SoilHasTheFarmsReflectance) {
  farm::Farm farm = farm_with(square({}), {1, 1, 1}, 0);
  const Ray ray{{5, 5, 3}, {0, 0, -1}};
  Hit hit;
  Scene(scene_content(farm)).cast({&ray, 1}, 100, {&hit, 1});
  EXPECT_EQ(hit.reflectance, 0.30F);
  farm.soil_reflectance = 0.12;
  Scene(scene_content(farm)).cast({&ray, 1}, 100, {&hit, 1});
  EXPECT_EQ(hit.reflectance, 0.12F);
}

TEST(Optics, ACheckerboardLetsHalfOfTheRaysThrough) {
  const auto mask = mask_of(png_of_grey(8, 8, [](int c, int r) { return (c + r) % 2 * 255; }));
  for (const float repeats : {1.0F, 3.0F}) {
    const mesh::Mesh board = square({.name = "leaf", .mask = mask}, repeats);
    // 240 rays a side: whole numbers of rays a field.
    EXPECT_EQ(share_stopped(hits_over(farm_with(board, {1, 1, 1}, 0), 240)), 0.5) << repeats;
    EXPECT_NEAR(share_stopped(hits_over(farm_with(board, {1.3, 0.7, 1}, 0.5), 240)), 0.5, 1e-3);
  }
}

TEST(Optics, WhatAHoleLetsThroughMeetsWhatIsBehind) {
  // The left half is a hole: u grows along the square's x.
  const auto mask = mask_of(png_of_grey(2, 1, [](int c, int) { return c * 255; }));
  const farm::Farm farm = farm_with(square({.name = "leaf", .mask = mask}), {1, 1, 1}, 0);
  const SceneContent content = scene_content(farm);
  const Scene scene(content);
  for (const double x : {-0.5, 0.5}) {
    const Eigen::Vector3d place =
        farm.plants[0].position + farm.plants[0].rotation * Eigen::Vector3d(x, 0.1, 3);
    const Ray ray{place.cast<float>(), {0, 0, -1}};
    Hit hit;
    scene.cast({&ray, 1}, 100, {&hit, 1});
    EXPECT_NEAR(hit.range_m, x < 0 ? 6 : 3, 1e-5);
    EXPECT_EQ(scene.surface(hit).plant, x < 0 ? 0u : 1u);
  }
}

TEST(Optics, ALeafsDiscHasItsArea) {
  constexpr int kTexels = 512;
  constexpr double kRadius = 200;
  const auto mask = mask_of(png_of_grey(kTexels, kTexels, [](int c, int r) {
    return std::hypot(c + 0.5 - kTexels / 2, r + 0.5 - kTexels / 2) < kRadius ? 255 : 0;
  }));
  const auto hits =
      hits_over(farm_with(square({.name = "leaf", .mask = mask}), {0.5, 0.5, 1}, 1.1), 700);
  const double expected = std::numbers::pi * std::pow(kRadius / kTexels, 2);
  EXPECT_NEAR(share_stopped(hits) / expected, 1, 2e-3);
}

// A real leaf's photograph as a mask; what of it is bright, VTK decodes too.
TEST(Optics, APhotographLetsThroughWhatAnotherDecoderSays) {
  const std::filesystem::path photograph =
      std::filesystem::path(PLOTSCAN_SHARED_DATA_DIR) / "plants/cropcraft/bean/bean_leaf.jpg";
  if (!std::filesystem::exists(photograph)) GTEST_SKIP() << photograph << " is not there";
  const testing::TemporaryFolder folder;
  std::filesystem::copy(photograph, folder.path() / "bean_leaf.jpg");
  folder.write("m.mtl", "newmtl leaf\nmap_Kd bean_leaf.jpg\nmap_d bean_leaf.jpg\n");
  const mesh::Mesh leaf = mesh::import_mesh(folder.write(
      "m.obj",
      "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "usemtl leaf\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"));
  vtkNew<vtkJPEGReader> reader;
  reader->SetFileName(photograph.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  const int* size = image.GetDimensions();
  std::size_t bright = 0;
  for (int row = 0; row < size[1]; ++row) {
    for (int column = 0; column < size[0]; ++column) {
      const auto* c = static_cast<const unsigned char*>(image.GetScalarPointer(column, row, 0));
      bright += 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2] >= 127.5 ? 1 : 0;
    }
  }
  const double expected = static_cast<double>(bright) / (size[0] * size[1]);
  const double found = share_stopped(hits_over(farm_with(leaf, {1, 1, 1}, 0.3), 500));
  std::printf("share of rays stopped %.4f, of bright pixels %.4f\n", found, expected);
  EXPECT_GT(expected, 0.05);
  EXPECT_LT(expected, 0.95);
  EXPECT_NEAR(found, expected, 0.005);
}

}  // namespace
}  // namespace plotscan::lidar
