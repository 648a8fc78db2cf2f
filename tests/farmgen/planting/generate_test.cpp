// SPDX-License-Identifier: Apache-2.0
#include "planting/generate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"
#include "description/load_description.h"
#include "farm/true_heights.h"
#include "planting/plot_layout.h"
#include "terrain/internal/base_terrains.h"

namespace plotscan::planting {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

farm::Farm example(std::uint64_t seed = 42, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return generate(description::load_description(write_example(folder), overrides), seed);
}

// The largest distance between the values' distribution and the uniform one over [low, high]
// (Kolmogorov-Smirnov). Beyond 1.95 / sqrt(n) with probability 0.001.
double distance_from_uniform(std::vector<double> values, double low, double high) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = (values[i] - low) / (high - low);
    const auto rank = static_cast<double>(i);
    distance =
        std::max({distance, std::abs(expected - rank / n), std::abs(expected - (rank + 1) / n)});
  }
  return distance;
}

void expect_uniform(const std::vector<double>& values, double low, double high) {
  EXPECT_GE(*std::min_element(values.begin(), values.end()), low);
  EXPECT_LE(*std::max_element(values.begin(), values.end()), high);
  EXPECT_LT(distance_from_uniform(values, low, high),
            1.95 / std::sqrt(static_cast<double>(values.size())));
}

TEST(RandomTerrain, IsADelaunayTriangulationOfTheSquare) {
  const terrain::Terrain terrain = terrain::random_terrain(30, 60, 0.5, 11);
  const auto& vertices = terrain.vertices();
  ASSERT_EQ(vertices.size(), 64u);
  double area = 0;
  for (const auto& [a, b, c] : terrain.triangles()) {
    const Eigen::Vector2d pa = vertices[a].head<2>();
    const Eigen::Vector2d pb = vertices[b].head<2>();
    const Eigen::Vector2d pc = vertices[c].head<2>();
    area += ((pb - pa).x() * (pc - pa).y() - (pb - pa).y() * (pc - pa).x()) / 2;
    // The centre is as far from all three: 2 (pb - pa) . x = |pb|^2 - |pa|^2, and so for pc.
    Eigen::Matrix2d rows;
    rows << (pb - pa).transpose(), (pc - pa).transpose();
    const Eigen::Vector2d right(pb.squaredNorm() - pa.squaredNorm(),
                                pc.squaredNorm() - pa.squaredNorm());
    const Eigen::Vector2d centre = rows.inverse() * right / 2;
    const double radius = (pa - centre).norm();
    for (const Eigen::Vector3d& other : vertices) {
      EXPECT_GE((other.head<2>() - centre).norm(), radius * (1 - 1e-9))
          << "a vertex inside a triangle's circumcircle";
    }
  }
  EXPECT_NEAR(area, 900, 1e-9) << "the triangles cover the square once";
  // Euler: a triangulation of n points, h of them on the hull, has 2 n - 2 - h triangles.
  EXPECT_EQ(terrain.triangles().size(), 2u * 64 - 2 - 4);
}

TEST(RandomTerrain, VerticesAreUniformAndIndependentOfTheirNumber) {
  const terrain::Terrain terrain = terrain::random_terrain(10, 3000, 0.7, 5);
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (std::size_t i = 4; i < terrain.vertices().size(); ++i) {
    x.push_back(terrain.vertices()[i].x());
    y.push_back(terrain.vertices()[i].y());
    z.push_back(terrain.vertices()[i].z());
  }
  expect_uniform(x, -5, 5);
  expect_uniform(y, -5, 5);
  expect_uniform(z, -0.7, 0.7);
  const terrain::Terrain fewer = terrain::random_terrain(10, 30, 0.7, 5);
  EXPECT_TRUE(
      std::equal(fewer.vertices().begin(), fewer.vertices().end(), terrain.vertices().begin()));
  const terrain::Terrain flat = terrain::random_terrain(10, 30, 0, 5);
  for (const Eigen::Vector3d& vertex : flat.vertices()) {
    EXPECT_EQ(vertex.z(), 0);
  }
}

TEST(PlotGrid, LiesAsDescribed) {
  PlotGridDescription grid{.width_m = 2,
                           .length_m = 5,
                           .gap_width_m = 1,
                           .gap_length_m = 3,
                           .heading_rad = 0,
                           .position_m = {10, 20},
                           .rows = {{.plots = 3, .offset_m = 0}, {.plots = 2, .offset_m = 4}}};
  // Row 1 spans x 0..8, row 2 x 4..9 in the grid's own frame; both rows y 0..13.
  const std::vector<farm::Plot> plots = grid_plots(grid);
  ASSERT_EQ(plots.size(), 5u);
  const std::vector<Eigen::Vector2d> centers = {
      {6.5, 16}, {9.5, 16}, {12.5, 16}, {10.5, 24}, {13.5, 24}};
  for (std::size_t i = 0; i < plots.size(); ++i) {
    EXPECT_EQ(plots[i].id, i + 1);
    EXPECT_EQ(plots[i].row, i < 3 ? 1 : 2);
    EXPECT_EQ(plots[i].column, i < 3 ? i + 1 : i - 2);
    EXPECT_TRUE(plots[i].box.center.isApprox(centers[i], 1e-12)) << plots[i].box.center.transpose();
    EXPECT_DOUBLE_EQ(plots[i].box.heading_rad, kPi / 2) << "length runs along y";
    EXPECT_EQ(plots[i].box.width_m, 2);
    EXPECT_EQ(plots[i].box.length_m, 5);
  }
  grid.heading_rad = kPi / 2;
  const std::vector<farm::Plot> turned = grid_plots(grid);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const Eigen::Vector2d offset = centers[i] - grid.position_m;
    const Eigen::Vector2d expected = grid.position_m + Eigen::Vector2d(-offset.y(), offset.x());
    EXPECT_TRUE(turned[i].box.center.isApprox(expected, 1e-12));
    EXPECT_NEAR(heading_difference(turned[i].box.heading_rad, 0), 0, 1e-12);
  }
}

TEST(PlotGrid, HasToLieOnTheTerrain) {
  const std::string message =
      message_of<InputError>([] { example(1, {"plots.position_m=[8, 0]"}); });
  EXPECT_THAT(message, HasSubstr("a corner of plot "));
  EXPECT_THAT(message, HasSubstr(" off the terrain, which spans x -10.00 m to 10.00 m"));
  EXPECT_THAT(message, HasSubstr("need a square terrain of side 2"));
  EXPECT_NO_THROW(
      example(1, {"plots.heading_deg=0", "plots.position_m=[0, 0]", "plots.rows=[{plots: 10}]",
                  "plots.gap_width_m=0.5", "plots.width_m=1.55", "terrain.side_m=20"}))
      << "a grid exactly as wide as the terrain fits";
  EXPECT_THROW(
      example(1, {"plots.heading_deg=0", "plots.position_m=[0, 0]", "plots.rows=[{plots: 10}]",
                  "plots.gap_width_m=0.5", "plots.width_m=1.5501", "terrain.side_m=20"}),
      InputError);
}

TEST(PlotFinder, AgreesWithTryingEveryPlot) {
  const farm::Farm farm = example();
  const PlotFinder finder(farm.plots);
  RandomStream random(3, random_purpose("test/points"), 0);
  std::set<std::uint32_t> found;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d point(random.uniform(-10, 10), random.uniform(-10, 10));
    std::uint32_t expected = 0;
    for (const farm::Plot& plot : farm.plots) {
      if (expected == 0 && plot.box.contains(point)) expected = plot.id;
    }
    ASSERT_EQ(finder.plot_at(point), expected);
    found.insert(expected);
  }
  EXPECT_EQ(found.size(), 6u) << "every plot, and none";
}

TEST(Generate, PlantsAreUniformInTheirPlots) {
  const farm::Farm farm = example(8, {"plants.count=900"});
  ASSERT_EQ(farm.plants.size(), 4500u);
  std::vector<double> along_length;
  std::vector<double> along_width;
  std::vector<double> yaw;
  std::array<std::vector<double>, 3> scale;
  std::map<std::uint32_t, int> per_model;
  for (const farm::Plant& plant : farm.plants) {
    const PlotBox& box = farm.plots[plant.plot - 1].box;
    const Eigen::Vector2d place = box.box_from_world(plant.position.head<2>());
    along_length.push_back(place.x() / box.length_m);
    along_width.push_back(place.y() / box.width_m);
    const Eigen::Vector3d forward = plant.rotation * Eigen::Vector3d::UnitX();
    EXPECT_EQ(forward.z(), 0) << "plants stand upright";
    yaw.push_back(std::atan2(forward.y(), forward.x()));
    for (int axis = 0; axis < 3; ++axis) scale[axis].push_back(plant.scale[axis]);
    ++per_model[plant.model];
  }
  expect_uniform(along_length, -0.5 - 1e-12, 0.5 + 1e-12);
  expect_uniform(along_width, -0.5 - 1e-12, 0.5 + 1e-12);
  expect_uniform(yaw, -kPi, kPi);
  for (const auto& axis : scale) expect_uniform(axis, 0.8, 1.2);
  // Independent: no correlation beyond 4 standard errors.
  double product = 0;
  for (std::size_t i = 0; i < scale[0].size(); ++i)
    product += (scale[0][i] - 1) * (scale[2][i] - 1);
  const double variance = 0.4 * 0.4 / 12;
  EXPECT_LT(std::abs(product / 4500 / variance), 4 / std::sqrt(4500.0));
  EXPECT_NEAR(per_model[0], 2250, 4 * std::sqrt(4500 * 0.25));
}

TEST(Generate, FeetAreOnTheTerrainAndHeightsAreTheModelsTimesTheScale) {
  const farm::Farm farm = example();
  for (const farm::Plant& plant : farm.plants) {
    EXPECT_EQ(plant.position.z(), farm.terrain.height(plant.position.x(), plant.position.y()));
    EXPECT_DOUBLE_EQ(plant.height_m, plant.scale.z() * farm.models[plant.model].height_m);
  }
}

TEST(Generate, HeightsAgreeWithEveryPlacedVertex) {
  const TemporaryFolder folder;
  const farm::Farm farm = generate(description::load_description(write_leaning_example(folder)), 5);
  ASSERT_EQ(farm.plants.size(), 4u);
  for (const farm::Plant& plant : farm.plants) {
    const Eigen::Affine3d world_from_model =
        Eigen::Translation3d(plant.position) * plant.rotation * Eigen::Scaling(plant.scale);
    double highest = -1e9;
    for (const Eigen::Vector3f& vertex : farm.models[plant.model].mesh.vertices) {
      highest = std::max(highest, (world_from_model * vertex.cast<double>()).z());
    }
    const double ground = farm.terrain.height(plant.position.x(), plant.position.y()).value();
    EXPECT_NEAR(plant.height_m, highest - ground, 1e-12) << "plant " << plant.id;
  }
  EXPECT_EQ(farm.plants[1].position.z(), 0.25) << "the table's z is respected";
  EXPECT_EQ(farm.plants[0].plot, 1u);
  EXPECT_EQ(farm.plots[0].plant_count, 3u);
}

TEST(Generate, DrilledPlantsStandInRows) {
  const farm::Farm farm = example(1, {"plants.pattern=drilled", "plants.drill_rows=3",
                                      "plants.count=20", "plots.heading_deg=0"});
  std::map<double, std::vector<double>> rows;  // across -> along, of plot 1
  for (const farm::Plant& plant : farm.plants) {
    if (plant.plot != 1) continue;
    const Eigen::Vector2d place = farm.plots[0].box.box_from_world(plant.position.head<2>());
    rows[std::round(place.y() * 1e6) / 1e6].push_back(place.x());
  }
  ASSERT_EQ(rows.size(), 3u);
  for (auto& [across, along] : rows) {
    EXPECT_NEAR(std::abs(across), across == 0 ? 0 : 0.5, 1e-6);
    std::sort(along.begin(), along.end());
    EXPECT_TRUE(along.size() == 7 || along.size() == 6);
    for (std::size_t i = 1; i < along.size(); ++i) {
      EXPECT_NEAR(along[i] - along[i - 1], 3.0 / static_cast<double>(along.size()), 1e-9);
    }
    EXPECT_NEAR(along.front() + along.back(), 0, 1e-9) << "centred";
  }
  const farm::Farm jittered = example(1, {"plants.pattern=drilled", "plants.drill_rows=3",
                                          "plants.jitter_m=0.4", "plots.heading_deg=0"});
  double largest = 0;
  for (std::size_t i = 0; i < farm.plants.size(); ++i) {
    const Eigen::Vector3d shift = jittered.plants[i].position - farm.plants[i].position;
    largest = std::max(largest, shift.head<2>().cwiseAbs().maxCoeff());
    const PlotBox& box = farm.plots[farm.plants[i].plot - 1].box;
    const Eigen::Vector2d place = box.box_from_world(jittered.plants[i].position.head<2>());
    EXPECT_LE(std::abs(place.x()), box.length_m / 2 + 1e-12);
    EXPECT_LE(std::abs(place.y()), box.width_m / 2 + 1e-12);
  }
  EXPECT_GT(largest, 0.3);
  EXPECT_LE(largest, 0.4 + 1e-12);
}

TEST(Generate, PlotHeightsAreOverTheirOwnPlants) {
  const farm::Farm farm = example();
  for (const farm::Plot& plot : farm.plots) {
    std::vector<double> heights;
    for (const farm::Plant& plant : farm.plants) {
      if (plant.plot == plot.id) heights.push_back(plant.height_m);
    }
    std::sort(heights.begin(), heights.end());
    ASSERT_EQ(heights.size(), 20u);
    EXPECT_EQ(plot.plant_count, 20u);
    double total = 0;
    for (const double height : heights) total += height;
    EXPECT_NEAR(plot.heights.mean, total / 20, 1e-12);
    EXPECT_EQ(plot.heights.max, heights.back());
    EXPECT_NEAR(plot.heights.p50, (heights[9] + heights[10]) / 2, 1e-12);
    EXPECT_NEAR(plot.heights.p90, heights[17] + 0.1 * (heights[18] - heights[17]), 1e-12);
    EXPECT_NEAR(plot.heights.p95, heights[18] + 0.05 * (heights[19] - heights[18]), 1e-12);
    EXPECT_NEAR(plot.heights.p99, heights[18] + 0.81 * (heights[19] - heights[18]), 1e-12);
  }
}

TEST(PlotHeights, Hand3IsTheMeanOfThreeDifferentPlants) {
  // Powers of ten show which plants were taken.
  std::vector<double> heights(8);
  for (int i = 0; i < 8; ++i) heights[i] = std::pow(10.0, i);
  std::set<long long> seen;
  std::array<int, 8> taken{};
  for (std::uint32_t plot = 1; plot <= 4000; ++plot) {
    const auto sum = std::llround(3 * farm::plot_heights(heights, 9, plot).hand3);
    std::string digits = std::to_string(sum);
    EXPECT_EQ(std::count(digits.begin(), digits.end(), '1'), 3) << "three different plants";
    EXPECT_EQ(std::count(digits.begin(), digits.end(), '0') + 3,
              static_cast<std::ptrdiff_t>(digits.size()));
    seen.insert(sum);
    for (std::size_t i = 0; i < digits.size(); ++i)
      taken[i] += digits[digits.size() - 1 - i] == '1';
  }
  EXPECT_EQ(seen.size(), 56u) << "every set of 3 of 8";
  for (const int count : taken) EXPECT_NEAR(count, 1500, 4 * std::sqrt(4000 * 0.375 * 0.625));
  EXPECT_DOUBLE_EQ(farm::plot_heights({0.5, 0.7}, 9, 1).hand3, 0.6) << "all of fewer than three";
  EXPECT_EQ(farm::plot_heights({}, 9, 1).max, 0);
}

TEST(Generate, OneStreamDoesNotDisturbAnother) {
  const farm::Farm farm = example(4);
  const farm::Farm rescaled = example(4, {"plants.scale=[0.5, 0.5]", "terrain.relief_m=0.1"});
  const farm::Farm other = example(5);
  std::size_t same = 0;
  for (std::size_t i = 0; i < farm.plants.size(); ++i) {
    EXPECT_EQ(farm.plants[i].position.head<2>(), rescaled.plants[i].position.head<2>());
    EXPECT_EQ(farm.plants[i].rotation.coeffs(), rescaled.plants[i].rotation.coeffs());
    EXPECT_EQ(farm.plants[i].model, rescaled.plants[i].model);
    same += farm.plants[i].position.x() == other.plants[i].position.x() ? 1 : 0;
  }
  EXPECT_EQ(same, 0u) << "another seed places every plant elsewhere";
}

TEST(Generate, ThePaperFarmsAreAsThePaperSays) {
  const fs::path worlds = fs::path(PLOTSCAN_SOURCE_DIR) / "worlds";
  const std::array<std::pair<const char*, double>, 3> farms = {
      {{"paper_flat.yaml", 0}, {"paper_half.yaml", 0.5}, {"paper_one.yaml", 1}}};
  for (const auto& [file, relief_m] : farms) {
    const farm::Farm farm = generate(description::load_description(worlds / file), 1);
    EXPECT_EQ(farm.terrain.vertices().size(), 154u);
    EXPECT_EQ(farm.models.size(), 5u);
    EXPECT_EQ(farm.plots.size(), 30u);
    EXPECT_EQ(farm.plots.back().row, 3);
    EXPECT_EQ(farm.plots.back().column, 10);
    EXPECT_EQ(farm.plants.size(), 2700u);
    double greatest = 0;
    for (const auto& vertex : farm.terrain.vertices()) {
      EXPECT_LE(vertex.head<2>().cwiseAbs().maxCoeff(), 40);
      greatest = std::max(greatest, std::abs(vertex.z()));
    }
    EXPECT_LE(greatest, relief_m);
    EXPECT_GE(greatest, 0.9 * relief_m);
  }
}

}  // namespace
}  // namespace plotscan::planting
