// SPDX-License-Identifier: Apache-2.0
#include "view/picture.h"

#include "core/error.h"
#include "temporary_folder.h"
#include "viewer/pixels.h"

namespace plotscan::view {
namespace {

// A flat square of 20 m with one plot of one upright, dark green slab.
farm::Farm slab_farm() {
  terrain::Terrain terrain({{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}},
                           {{0, 1, 2}, {0, 2, 3}});
  farm::PlantModel slab{
      .name = "slab", .mesh = {.vertices = {}, .triangles = {{0, 1, 2}, {0, 2, 3}}}, .height_m = 1};
  slab.mesh.vertices = {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}};
  const farm::Plot plot{.id = 1,
                        .row = 1,
                        .column = 1,
                        .box = {.width_m = 2, .length_m = 4},
                        .plant_count = 1,
                        .heights = {}};
  farm::Plant plant;
  plant.id = 1;
  plant.plot = 1;
  plant.height_m = 1;
  return {.name = "slab",
          .seed = 1,
          .terrain = terrain,
          .models = {slab},
          .plots = {plot},
          .plants = {plant}};
}

std::filesystem::path small_cloud(const testing::TemporaryFolder& folder) {
  std::string points;
  int count = 0;
  for (double x = -2; x <= 2; x += 0.05) {
    for (double z = 0; z <= 1; z += 0.05, ++count) {
      points += std::to_string(x) + " 0 " + std::to_string(z) + "\n";
    }
  }
  const std::string size = std::to_string(count);
  return folder.write(
      "cloud.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + size +
                       "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + size + "\nDATA ascii\n" +
                       points);
}

bool vermilion_box(const Colour& c) { return c[0] > 190 && c[1] < 125 && c[2] < 50; }

TEST(Picture, ShowsPlantsOnTheLeftAndCloudWithBoxesOnTheRight) {
  const testing::TemporaryFolder folder;
  const auto farm = slab_farm();
  const PictureOptions options{.width_px = 600, .height_px = 300};
  draw_picture(farm, small_cloud(folder), {farm.plots[0].box}, folder.path() / "with.png", options);
  EXPECT_GT(count_pixels(folder.path() / "with.png", 0, 0.5, green), 50);
  EXPECT_GT(count_pixels(folder.path() / "with.png", 0.5, 1, green), 50);
  EXPECT_EQ(count_pixels(folder.path() / "with.png", 0, 0.5, vermilion_box), 0);
  EXPECT_GT(count_pixels(folder.path() / "with.png", 0.5, 1, vermilion_box), 50);

  draw_picture(farm, small_cloud(folder), {}, folder.path() / "without.png", options);
  EXPECT_EQ(count_pixels(folder.path() / "without.png", 0, 1, vermilion_box), 0);
}

TEST(Picture, OfAFarmAloneFillsThePicture) {
  const testing::TemporaryFolder folder;
  draw_picture(slab_farm(), std::nullopt, {}, folder.path() / "farm.png",
               {.width_px = 300, .height_px = 300});
  EXPECT_GT(count_pixels(folder.path() / "farm.png", 0, 1, green), 50);
}

TEST(Picture, ShowsMaterialsColoursAndWeedsApartFromTheCrop) {
  const testing::TemporaryFolder folder;
  farm::Farm farm = slab_farm();
  farm.models[0].mesh.materials = {{.name = "leaf", .colour = {0.1F, 0.2F, 0.9F}, .texture = {}}};
  const PictureOptions options{.width_px = 300, .height_px = 300};
  draw_picture(farm, std::nullopt, {}, folder.path() / "crop.png", options);
  EXPECT_GT(count_pixels(folder.path() / "crop.png", 0, 1, blue), 50);
  EXPECT_EQ(count_pixels(folder.path() / "crop.png", 0, 1, green), 0);

  farm.plants[0].kind = farm::PlantKind::weed;
  draw_picture(farm, std::nullopt, {}, folder.path() / "weed.png", options);
  EXPECT_EQ(count_pixels(folder.path() / "weed.png", 0, 1, blue), 0);
  EXPECT_GT(count_pixels(folder.path() / "weed.png", 0, 1,
                         [](Colour c) { return c[0] > c[1] + 25 && c[2] > c[1] + 25; }),
            50);
}

TEST(Picture, RefusesImpossibleSizesAndPlaces) {
  const testing::TemporaryFolder folder;
  const auto draw = [&](const PictureOptions& options, const std::string& name) {
    draw_picture(slab_farm(), std::nullopt, {}, folder.path() / name, options);
  };
  EXPECT_THROW(draw({.width_px = 1}, "a.png"), InputError);
  EXPECT_THROW(draw({.elevation_deg = -3}, "a.png"), InputError);
  EXPECT_THROW(draw({.width_px = 256, .height_px = 64}, "absent/a.png"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.png"));
}

}  // namespace
}  // namespace plotscan::view
