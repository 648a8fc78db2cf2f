// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/angle.h"
#include "core/yaml_section.h"
#include "description/internal/sections.h"
#include "description/internal/shared_keys.h"

namespace plotscan::description {
namespace {

constexpr Range kSide = {1, 100000};
constexpr Range kRelief = {0, 1000};
constexpr std::int64_t kMostVertices = 1'000'000;

const std::vector<std::string> kBases = {"mesh", "heightmap", "xyz"};

double angle_at(const YamlSection& section, const std::string& key) {
  return section.number(key, {-360, 360}, 0.0) * kDegrees;
}

terrain::HeightmapDescription read_heightmap(const YamlSection& section) {
  terrain::HeightmapDescription heightmap;
  heightmap.image = file_at(section, "heightmap");
  if (section.has("size_m")) {
    if (section.has("side_m")) section.fail("side_m", "is size_m's x; give one of the two");
    const auto [x, y] = section.pair("size_m", kSide);
    heightmap.size_x_m = x;
    heightmap.size_y_m = y;
  } else {
    heightmap.size_x_m = section.number("side_m", kSide);
  }
  const auto [black, white] = section.pair("height_m", {-10000, 10000});
  heightmap.black_m = black;
  heightmap.white_m = white;
  return heightmap;
}

terrain::XyzDescription read_xyz(const YamlSection& section) {
  terrain::XyzDescription xyz;
  xyz.file = file_at(section, "xyz");
  xyz.keep_coordinates = section.choice("keep_coordinates", {"false", "true"}, 0) == 1;
  return xyz;
}

void read_random_square(const YamlSection& section, terrain::TerrainDescription& terrain) {
  terrain.side_m = section.number("side_m", kSide);
  terrain.vertices =
      static_cast<std::uint32_t>(section.integer("vertices", 0, kMostVertices, terrain.vertices));
  terrain.relief_m = section.number("relief_m", kRelief, terrain.relief_m);
}

void read_base(const YamlSection& section, terrain::TerrainDescription& terrain) {
  std::string base;
  for (const std::string& key : kBases) {
    if (!section.has(key)) continue;
    if (!base.empty()) section.fail(key, "takes the place of {}; give one of the two", base);
    base = key;
  }
  if (base == "mesh") {
    terrain.mesh = file_at(section, "mesh");
    terrain.mesh_options = read_mesh_options(section);
  } else if (base == "heightmap") {
    terrain.heightmap = read_heightmap(section);
  } else if (base == "xyz") {
    terrain.xyz = read_xyz(section);
  } else {
    read_random_square(section, terrain);
  }
}

terrain::SlopeDescription read_slope(const YamlSection& section) {
  return {.gradient = section.number("percent", {0, 100}) / 100,
          .direction_rad = angle_at(section, "direction_deg")};
}

terrain::RollingDescription read_rolling(const YamlSection& section) {
  const auto [shortest, longest] = section.pair("wavelength_m", {0.5, 100000});
  if (shortest > longest)
    section.fail("wavelength_m", "is not [shortest, longest]: the first is the longer");
  return {.rms_m = section.number("rms_m", kRelief), .shortest_m = shortest, .longest_m = longest};
}

terrain::FurrowsDescription read_furrows(const YamlSection& section) {
  const bool trapezoid = section.choice("profile", {"sine", "trapezoid"}, 0) == 1;
  return {.spacing_m = section.number("spacing_m", {0.05, 100}),
          .depth_m = section.number("depth_m", {0, 10}),
          .heading_rad = angle_at(section, "heading_deg"),
          .offset_m = section.number("offset_m", {-100, 100}, 0.0),
          .profile = trapezoid ? terrain::FurrowProfile::trapezoid : terrain::FurrowProfile::sine};
}

terrain::ClodsDescription read_clods(const YamlSection& section) {
  return {.height_m = section.number("height_m", {0, 1}),
          .size_m = section.number("size_m", {0.01, 10})};
}

// Parts without height need no vertices.
void drop_flat_parts(terrain::TerrainDescription& terrain) {
  if (terrain.rolling && terrain.rolling->rms_m == 0) terrain.rolling.reset();
  if (terrain.furrows && terrain.furrows->depth_m == 0) terrain.furrows.reset();
  if (terrain.clods && terrain.clods->height_m == 0) terrain.clods.reset();
}

}  // namespace

terrain::TerrainDescription read_terrain(const YamlSection& section) {
  terrain::TerrainDescription terrain;
  read_base(section, terrain);
  if (section.has("slope")) terrain.slope = read_slope(section.section("slope"));
  if (section.has("rolling")) terrain.rolling = read_rolling(section.section("rolling"));
  if (section.has("furrows")) terrain.furrows = read_furrows(section.section("furrows"));
  if (section.has("clods")) terrain.clods = read_clods(section.section("clods"));
  if (section.has("step_m")) terrain.step_m = section.number("step_m", {0.005, 1000});
  if (section.has("detail_m")) {
    const auto [x, y] = section.pair("detail_m", kSide);
    terrain.detail_m = {x, y};
  }
  if (section.has("reflectance")) terrain.reflectance = reflectance_at(section, "reflectance");
  if (terrain.detail_m && !terrain.furrows && !terrain.clods)
    section.fail("detail_m", "bounds furrows and clods; the terrain has none");
  if (terrain.step_m && !terrain.rolling && !terrain.furrows && !terrain.clods)
    section.fail("step_m", "is of rolling, furrows or clods; the terrain has none");
  drop_flat_parts(terrain);
  return terrain;
}

}  // namespace plotscan::description
