// SPDX-License-Identifier: Apache-2.0
// Terrains from descriptions: the user's files, refusals, farms on rough ground.
#include "terrain/make_terrain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "../example_farm.h"
#include "core/error.h"
#include "description/load_description.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "planting/generate.h"
#include "terrain/internal/refine.h"

namespace plotscan::terrain {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// Writes a grey or colour PNG through libpng's simplified interface or, for 16 bits, its low one.
void write_png(const fs::path& path, std::uint32_t width, std::uint32_t height, int bits,
               int colour_type, std::vector<std::uint8_t> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, bits, colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::uint32_t row = 0; row < height; ++row)
    png_write_row(png, bytes.data() + row * (bytes.size() / height));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

planting::FarmDescription on_terrain(const TemporaryFolder& folder, const std::string& terrain) {
  return description::load_description(folder.write(
      "farm.yaml", "terrain: {" + terrain +
                       "}\nplots: {width_m: 1, length_m: 1, rows: [{plots: 1}]}\n"
                       "plants: {count: 3, models: [" +
                       (testing::models_folder() / "soybean_1.obj").string() + "]}\n"));
}

Terrain terrain_of(const TemporaryFolder& folder, const std::string& terrain) {
  return planting::generate(on_terrain(folder, terrain), 1).terrain;
}

std::string refusal(const TemporaryFolder& folder, const std::string& terrain) {
  return message_of<InputError>([&] { terrain_of(folder, terrain); });
}

TEST(Heightmap, ItsCornersAreTheTerrainsWithTheFirstRowInTheNorth) {
  const TemporaryFolder folder;
  write_png(folder.path() / "h.png", 3, 2, 8, PNG_COLOR_TYPE_GRAY, {0, 51, 255, 102, 0, 153});
  const Terrain terrain =
      terrain_of(folder, "heightmap: h.png, size_m: [20, 10], height_m: [1, 6]");
  EXPECT_EQ(terrain.vertices().size(), 6u);
  EXPECT_DOUBLE_EQ(terrain.height(-10, 5).value(), 1) << "north west, black";
  EXPECT_DOUBLE_EQ(terrain.height(0, 5).value(), 2);
  EXPECT_DOUBLE_EQ(terrain.height(10, 5).value(), 6) << "north east, white";
  EXPECT_DOUBLE_EQ(terrain.height(-10, -5).value(), 3) << "south west";
  EXPECT_DOUBLE_EQ(terrain.height(10, -5).value(), 4);
  EXPECT_DOUBLE_EQ(terrain.height(-10, 0).value(), 2) << "half way between the rows";
  EXPECT_FALSE(terrain.height(10.01, 0));
  const Terrain square = terrain_of(folder, "heightmap: h.png, side_m: 20, height_m: [6, 1]");
  EXPECT_DOUBLE_EQ(square.height(-10, 5).value(), 6) << "black may be high; pixels are square";
  EXPECT_FALSE(square.height(0, 5.01));
}

TEST(Heightmap, SixteenBitsAreKept) {
  const TemporaryFolder folder;
  write_png(folder.path() / "h.png", 2, 2, 16, PNG_COLOR_TYPE_GRAY,
            {0x12, 0x34, 0x12, 0x35, 0, 0, 0xff, 0xff});
  const Terrain terrain = terrain_of(folder, "heightmap: h.png, side_m: 4, height_m: [0, 65.535]");
  EXPECT_NEAR(terrain.height(-2, 2).value(), 0x1234 * 0.001, 1e-12);
  EXPECT_NEAR(terrain.height(2, 2).value(), 0x1235 * 0.001, 1e-12);
  EXPECT_NEAR(terrain.height(2, -2).value(), 65.535, 1e-12);
}

TEST(Heightmap, OtherImagesAreRefused) {
  const TemporaryFolder folder;
  const std::string sizes = ", side_m: 4, height_m: [0, 1]";
  write_png(folder.path() / "c.png", 1, 2, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3, 4, 5, 6});
  EXPECT_THAT(refusal(folder, "heightmap: c.png" + sizes),
              HasSubstr("c.png: is an image in colour"));
  write_png(folder.path() / "s.png", 1, 2, 8, PNG_COLOR_TYPE_GRAY, {1, 2});
  EXPECT_THAT(refusal(folder, "heightmap: s.png" + sizes), HasSubstr("fewer than 2 x 2 pixels"));
  write_png(folder.path() / "b.png", 2100, 2100, 1, PNG_COLOR_TYPE_GRAY,
            std::vector<std::uint8_t>(263 * 2100));
  EXPECT_THAT(refusal(folder, "heightmap: b.png" + sizes),
              HasSubstr("has 2100 x 2100 pixels; at most 4000000 are allowed"));
  folder.write("t.png", "not an image");
  EXPECT_THAT(refusal(folder, "heightmap: t.png" + sizes), HasSubstr("t.png: is not a sound PNG"));
  fs::resize_file(folder.path() / "c.png", 60);
  write_png(folder.path() / "g.png", 90, 90, 8, PNG_COLOR_TYPE_GRAY,
            std::vector<std::uint8_t>(8100, 7));
  fs::resize_file(folder.path() / "g.png", fs::file_size(folder.path() / "g.png") - 30);
  EXPECT_THAT(refusal(folder, "heightmap: g.png" + sizes), HasSubstr("g.png: is not a sound PNG"));
  EXPECT_THAT(refusal(folder, "heightmap: g.png, side_m: 4"), HasSubstr("height_m is missing"));
  EXPECT_THAT(refusal(folder, "heightmap: g.png, side_m: 4, size_m: [4, 4], height_m: [0, 1]"),
              HasSubstr("terrain.side_m is size_m's x"));
  EXPECT_THAT(refusal(folder, "heightmap: g.png, mesh: g.png"),
              HasSubstr("terrain.heightmap takes the place of mesh"));
}

TEST(Xyz, PointsOfAGridInAnyOrderAreMetExactly) {
  const TemporaryFolder folder;
  std::vector<Eigen::Vector3d> points;
  std::string text = "# easting northing height\n";
  for (int i = 0; i < 35; ++i) {  // 7 x 5, shuffled: 12 and 35 have no common factor
    const int place = 12 * i % 35;
    points.emplace_back(540000 + 2.5 * (place % 7), 4118000 + 2.5 * (place / 7.0 - place % 7 / 7.0),
                        600 + 0.25 * (place % 3));
    char line[128];
    std::snprintf(line, sizeof line, i % 2 ? "%.17g, %.17g;%.17g # p\r\n" : " %.17g\t%.17g %.17g\n",
                  points.back().x(), points.back().y(), points.back().z());
    text += line;
  }
  folder.write("grid.xyz", text);
  const farm::Farm farm = planting::generate(on_terrain(folder, "xyz: grid.xyz"), 1);
  EXPECT_EQ(farm.terrain_origin_m, Eigen::Vector3d(540007.5, 4118005, 600.25));
  EXPECT_EQ(farm.terrain.triangles().size(), 48u);
  for (const Eigen::Vector3d& point : points) {
    EXPECT_NEAR(farm.terrain.height(point.x() - 540007.5, point.y() - 4118005).value(),
                point.z() - 600.25, 1e-12);
  }
  farmfolder::write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
  EXPECT_EQ(farmfolder::read_farm(folder.path() / "farm").terrain_origin_m, farm.terrain_origin_m);
  EXPECT_THAT(refusal(folder, "xyz: grid.xyz, keep_coordinates: true"),
              HasSubstr("grid.xyz: terrain vertex 0 is more than 100 km from the farm's centre"));
}

TEST(Xyz, ScatteredPointsKeepTheirCoordinatesWhereAsked) {
  const TemporaryFolder folder;
  folder.write("p.xyz", "-3 -3 0\n9 -3 0\n-3 9 0\n9 9 0\n2 1 1\n");
  const farm::Farm farm =
      planting::generate(on_terrain(folder, "xyz: p.xyz, keep_coordinates: true"), 1);
  EXPECT_FALSE(farm.terrain_origin_m);
  EXPECT_EQ(farm.terrain.height(2, 1), 1.0);
  EXPECT_EQ(farm.terrain.triangles().size(), 4u);
}

TEST(Xyz, AByteOrderMarkIsPassedOver) {
  const TemporaryFolder folder;
  folder.write("p.xyz", "\xef\xbb\xbf-3 -3 0\n9 -3 0\n-3 9 0\n9 9 0\n");
  EXPECT_EQ(planting::generate(on_terrain(folder, "xyz: p.xyz"), 1).terrain.vertices().size(), 4u);
}

TEST(Xyz, BrokenFilesAreRefusedWithTheLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    folder.write("p.xyz", text);
    return refusal(folder, "xyz: p.xyz");
  };
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(message("1e308 0 0\n1.1e308 1 0\n1.2e308 0 1\n"),
              HasSubstr("p.xyz: has a coordinate beyond 1e+09"));
  EXPECT_THAT(message(three + "0 0\n"), HasSubstr("p.xyz:4: has 2 of the three numbers"));
  EXPECT_THAT(message(three + "0 0 0 7\n"), HasSubstr("p.xyz:4: has more than three numbers"));
  EXPECT_THAT(message(three + "2 0 nan\n"), HasSubstr("p.xyz:4: \"nan\" is not finite"));
  EXPECT_THAT(message("x y z\n" + three), HasSubstr("p.xyz:1: \"x\" is not a number"));
  EXPECT_THAT(message("#\n" + three + "\n1.0 0e5 3\n"),
              HasSubstr("p.xyz:6: has the x and y of line 3 again"));
  EXPECT_THAT(message("0 0 0\n1 1 1\n"), HasSubstr("p.xyz: has 2 points"));
  EXPECT_THAT(message("0 0 0\n1 1 1\n2 2 2\n"), HasSubstr("no triangle with an area"));
  EXPECT_THAT(message(""), HasSubstr("has 0 points"));
}

TEST(RoughGround, IsTheSameForASeedAndAnotherForAnother) {
  const TemporaryFolder folder;
  const planting::FarmDescription description = on_terrain(
      folder,
      "side_m: 12, relief_m: 0.2, slope: {percent: 3, direction_deg: 45}, "
      "rolling: {rms_m: 0.1, wavelength_m: [3, 6]}, furrows: {spacing_m: 0.75, depth_m: 0.1}, "
      "clods: {height_m: 0.02, size_m: 0.2}");
  const farm::Farm a = planting::generate(description, 5);
  const farm::Farm b = planting::generate(description, 5);
  EXPECT_EQ(a.terrain.vertices(), b.terrain.vertices());
  EXPECT_EQ(a.terrain.triangles(), b.terrain.triangles());
  EXPECT_NE(a.terrain.vertices(), planting::generate(description, 6).terrain.vertices());
  for (const farm::Plant& plant : a.plants) {
    EXPECT_EQ(plant.position.z(), a.terrain.height(plant.position.x(), plant.position.y()));
  }
}

TEST(RoughGround, PartsOfAMeshThatIsNotConvexStayOpen) {
  const TemporaryFolder folder;
  // An L of three squares of 10 m.
  folder.write("l.obj",
               "v -10 -10 0\nv 0 -10 0\nv 10 -10 0\nv -10 0 0\nv 0 0 0\nv 10 0 0\nv -10 10 0\n"
               "v 0 10 0\nf 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\n");
  TerrainDescription description;
  description.mesh = folder.path() / "l.obj";
  description.furrows = {.spacing_m = 0.8, .depth_m = 0.1};
  const Terrain terrain = make_terrain(description, {}, 1, "farm.yaml").terrain;
  EXPECT_FALSE(terrain.height(0.05, 0.05));
  EXPECT_FALSE(terrain.height(5, 5));
  EXPECT_NEAR(terrain.height(-5, 4).value(), 0.05, 0.01);
  EXPECT_TRUE(terrain.height(-0.001, 9.99));
}

TEST(RoughGround, TooFineOrTooCoarseIsRefusedSayingWhatWouldFit) {
  const TemporaryFolder folder;
  const std::string clods = "side_m: 100, clods: {height_m: 0.03, size_m: 0.08}, ";
  EXPECT_THAT(refusal(folder, clods + "detail_m: [100, 100]"),
              HasSubstr("farm.yaml: terrain: vertices 0.0251 m apart over 100.0 m x 100.0 m are "
                        "about 1.58e+07; at most 4e+06 are allowed: terrain.step_m from 0.053 on"));
  EXPECT_THAT(refusal(folder, clods + "step_m: 0.1"),
              HasSubstr("farm.yaml: terrain.step_m 0.1 is too coarse"));
  EXPECT_THAT(refusal(folder, "side_m: 100000, rolling: {rms_m: 1, wavelength_m: [1, 2]}"),
              HasSubstr("or longer waves"));
  EXPECT_THAT(refusal(folder,
                      "side_m: 10000, detail_m: [10000, 1], "
                      "furrows: {spacing_m: 0.8, depth_m: 0.1, heading_deg: 45}"),
              HasSubstr("furrows along that rectangle, a shorter terrain.detail_m"));
  EXPECT_THAT(refusal(folder, "side_m: 9, rolling: {rms_m: 1, wavelength_m: [9, 2]}"),
              HasSubstr("terrain.rolling.wavelength_m is not [shortest, longest]"));
  EXPECT_THAT(refusal(folder, "side_m: 9, step_m: 0.1"), HasSubstr("terrain.step_m is of rolling"));
  EXPECT_THAT(refusal(folder, "side_m: 9, detail_m: [3, 3]"),
              HasSubstr("terrain.detail_m bounds furrows and clods"));
  EXPECT_THAT(refusal(folder, "side_m: 9, slope: {percent: nan}"),
              HasSubstr("terrain.slope.percent nan is not in [0, 100]"));
  EXPECT_THAT(refusal(folder, "side_m: 9, furrows: {spacing_m: 0.7, depht_m: 1}"),
              HasSubstr("terrain.furrows.depht_m is not a known key"));
  EXPECT_EQ(terrain_of(folder, "side_m: 9, vertices: 0, furrows: {spacing_m: 0.7, depth_m: 0}")
                .vertices()
                .size(),
            4u)
      << "furrows without depth need no vertices";
}

}  // namespace
}  // namespace plotscan::terrain
