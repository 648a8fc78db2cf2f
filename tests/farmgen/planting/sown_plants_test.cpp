// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/angle.h"
#include "core/error.h"
#include "description/load_description.h"
#include "planting/generate.h"
#include "planting/internal/plants.h"

namespace plotscan::planting {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// 100 plots of 1.2 x 4 m.
farm::Farm trial(const std::string& plants, std::uint64_t seed = 6, const std::string& more = "") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "trial.yaml",
      "terrain: {side_m: 100, vertices: 30, relief_m: 0.3}\n"
      "plots: {width_m: 1.2, length_m: 4, gap_width_m: 0.3, gap_length_m: 1, heading_deg: 20, "
      "rows: [{plots: 25}, {plots: 25}, {plots: 25}, {plots: 25}]" +
          more + "}\nplants:\n  models: [" + (testing::models_folder() / "soybean_1.obj").string() +
          ", " + (testing::models_folder() / "soybean_2.obj").string() + "]\n" + plants);
  return generate(description::load_description(file), seed);
}

const farm::Plot& plot_of(const farm::Farm& farm, const farm::Plant& plant) {
  return *std::find_if(farm.plots.begin(), farm.plots.end(),
                       [&](const farm::Plot& plot) { return plot.id == plant.plot; });
}

Eigen::Vector2d place_of(const farm::Farm& farm, const farm::Plant& plant) {
  return plot_of(farm, plant).box.box_from_world(plant.position.head<2>());
}

struct Moments {
  double mean = 0;
  double sd = 0;
};

Moments moments_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Moments moments;
  for (const double value : values) moments.mean += value / n;
  for (const double value : values) moments.sd += std::pow(value - moments.mean, 2) / n;
  moments.sd = std::sqrt(moments.sd);
  return moments;
}

TEST(SownPlants, HeightsAreOfATruncatedNormalOfTheirCultivar) {
  const farm::Farm farm = trial(
      "  count: 40\n"
      "  scale: [0.9, 1.1]\n"
      "  cultivars:\n"
      "    - {name: tall, height_m: {mean: 1.1, sd: 0.12}}\n"
      "    - {name: short, height_m: {mean: 0.6, sd: 0.05}}\n");
  std::map<std::string, std::vector<double>> heights;
  for (const farm::Plant& plant : farm.plants) {
    EXPECT_DOUBLE_EQ(plant.height_m, plant.scale.z() * farm.models[plant.model].height_m);
    EXPECT_GE(plant.scale.x(), 0.9);
    EXPECT_LE(plant.scale.x(), 1.1);
    heights[plot_of(farm, plant).accession].push_back(plant.height_m);
  }
  // The normal distribution cut off at 3 standard deviations on either side.
  const double density = std::exp(-4.5) / std::sqrt(2 * std::numbers::pi);
  const double narrower = std::sqrt(1 - 6 * density / std::erf(3 / std::sqrt(2.0)));
  const std::map<std::string, Moments> expected = {{"tall", {1.1, 0.12}}, {"short", {0.6, 0.05}}};
  ASSERT_EQ(heights.size(), expected.size());
  for (const auto& [name, values] : heights) {
    ASSERT_EQ(values.size(), 2000u);
    const Moments drawn = moments_of(values);
    const auto& [mean, sd] = expected.at(name);
    EXPECT_NEAR(drawn.mean, mean, 4 * sd * narrower / std::sqrt(2000.0)) << name;
    EXPECT_NEAR(drawn.sd, sd * narrower, 4 * sd / std::sqrt(2 * 2000.0)) << name;
    EXPECT_GE(*std::min_element(values.begin(), values.end()), mean - 3 * sd);
    EXPECT_LE(*std::max_element(values.begin(), values.end()), mean + 3 * sd);
  }
}

TEST(SownPlants, WhatACultivarDoesNotSayThePlantsSay) {
  const farm::Farm farm = trial(
      "  density_m2: 10\n"
      "  pattern: drilled\n"
      "  drill_rows: 2\n"
      "  design: cycle\n"
      "  cultivars:\n"
      "    - {name: as_plants}\n"
      "    - {name: own, count: 7, pattern: random, models: [{crop: soybean, seed: 9}]}\n");
  ASSERT_EQ(farm.models.size(), 3u);
  EXPECT_EQ(farm.models[2].name, "soybean_s9");
  std::set<double> across;
  for (const farm::Plot& plot : farm.plots) {
    EXPECT_EQ(plot.plant_count, plot.accession == "own" ? 7u : 48u);
    EXPECT_EQ(plot.accession, plot.id % 2 == 0 ? "own" : "as_plants");
  }
  for (const farm::Plant& plant : farm.plants) {
    const bool own = plot_of(farm, plant).accession == "own";
    EXPECT_EQ(plant.model == 2, own);
    if (own) continue;
    EXPECT_NEAR(std::abs(place_of(farm, plant).y()), 0.3, 1e-9);
  }
}

// A tuft is a piece of a drill row along its mesh's x axis.
TEST(SownPlants, YawOfTheRowTurnsModelsAlongItEitherWay) {
  const farm::Farm farm = trial(
      "  count: 90\n"
      "  pattern: drilled\n"
      "  drill_rows: 2\n"
      "  yaw: row\n");
  std::size_t forward = 0;
  for (const farm::Plant& plant : farm.plants) {
    const Eigen::Vector3d x = plant.rotation * Eigen::Vector3d::UnitX();
    const double along = x.head<2>().dot(plot_of(farm, plant).box.length_axis());
    EXPECT_NEAR(std::abs(along), 1, 1e-9);
    forward += along > 0 ? 1 : 0;
  }
  const auto plants = static_cast<double>(farm.plants.size());
  EXPECT_NEAR(static_cast<double>(forward), plants / 2, 2 * std::sqrt(plants));
}

TEST(SownPlants, SeedsFailAtTheRateAndTheOthersStay) {
  const farm::Farm all = trial("  count: 90\n");
  const farm::Farm some = trial("  count: 90\n  missing: {rate: 0.07}\n");
  const double missing = 9000.0 - static_cast<double>(some.plants.size());
  EXPECT_NEAR(missing, 9000 * 0.07, 4 * std::sqrt(9000 * 0.07 * 0.93));
  std::size_t place = 0;
  for (const farm::Plant& plant : some.plants) {
    while (all.plants[place].position != plant.position) ASSERT_LT(++place, all.plants.size());
    EXPECT_EQ(all.plants[place].rotation.coeffs(), plant.rotation.coeffs());
    EXPECT_EQ(all.plants[place].scale, plant.scale);
  }
  for (std::size_t i = 0; i < some.plots.size(); ++i) {
    EXPECT_EQ(some.plots[i].plant_count + some.plots[i].missing_plants, 90u);
    EXPECT_EQ(all.plots[i].missing_plants, 0u);
  }
}

TEST(SownPlants, GapsOfDrilledRowsAreEmptyAndOfOneRow) {
  constexpr double kSpacing = 0.01;  // 400 seeds in a row of 4 m
  const farm::Farm farm = trial(
      "  count: 1200\n"
      "  pattern: drilled\n"
      "  drill_rows: 3\n"
      "  missing: {gaps_per_plot: 1, gap_length_m: 0.4}\n");
  std::map<std::pair<std::uint32_t, int>, std::vector<double>> rows;
  for (const farm::Plant& plant : farm.plants) {
    const Eigen::Vector2d place = place_of(farm, plant);
    rows[{plant.plot, static_cast<int>(std::lround(place.y() / 0.4))}].push_back(place.x());
  }
  for (auto& [row, along] : rows) {
    along.push_back(-2 - kSpacing / 2);
    along.push_back(2 + kSpacing / 2);
    std::sort(along.begin(), along.end());
    for (std::size_t i = 1; i < along.size(); ++i) {
      const double apart = along[i] - along[i - 1];
      EXPECT_TRUE(apart < kSpacing + 1e-9 || apart > 0.4) << "a gap of " << apart;
    }
  }
  // Poisson: without any gap with probability exp(-1); one gap leaves two rows whole.
  int whole = 0;
  int one_gap = 0;
  for (const farm::Plot& plot : farm.plots) {
    whole += plot.missing_plants == 0 ? 1 : 0;
    if (plot.missing_plants == 0 || plot.missing_plants > 41) continue;
    ++one_gap;
    int rows_with_gap = 0;
    for (int row = -1; row <= 1; ++row) rows_with_gap += rows[{plot.id, row}].size() < 402 ? 1 : 0;
    EXPECT_EQ(rows_with_gap, 1);
  }
  EXPECT_GT(one_gap, 0);
  const double p = std::exp(-1.0);
  EXPECT_NEAR(whole, 100 * p, 4 * std::sqrt(100 * p * (1 - p)));
}

TEST(SownPlants, GapsOfRandomPlantsReachAcrossTheWidth) {
  const farm::Farm all = trial("  count: 300\n");
  const farm::Farm some =
      trial("  count: 300\n  missing: {gaps_per_plot: 0.5, gap_length_m: 0.5}\n");
  std::map<std::uint32_t, std::vector<double>> left;
  std::map<std::uint32_t, std::vector<double>> gone;
  std::size_t next = 0;
  for (const farm::Plant& plant : all.plants) {
    const bool stays = next < some.plants.size() && some.plants[next].position == plant.position;
    next += stays ? 1 : 0;
    (stays ? left : gone)[plant.plot].push_back(place_of(all, plant).x());
  }
  EXPECT_EQ(next, some.plants.size());
  int gaps = 0;
  for (const auto& [plot, places] : gone) {
    const auto [least, greatest] = std::minmax_element(places.begin(), places.end());
    if (*greatest - *least > 0.5) continue;  // two gaps
    ++gaps;
    for (const double place : left[plot]) EXPECT_FALSE(place > *least && place < *greatest);
  }
  EXPECT_GT(gaps, 10);
}

TEST(SownPlants, MissingPlotsLeaveTheirNumberAndTheOthersAsTheyAre) {
  const farm::Farm all = trial("  count: 5\n");
  const farm::Farm some = trial("  count: 5\n", 6, ", missing: [2, 100], missing_rate: 0.1");
  std::set<std::uint32_t> numbers;
  for (const farm::Plot& plot : some.plots) numbers.insert(plot.id);
  EXPECT_FALSE(numbers.contains(2));
  EXPECT_FALSE(numbers.contains(100));
  EXPECT_LT(numbers.size(), 98u);
  EXPECT_NEAR(static_cast<double>(numbers.size()), 98 * 0.9, 4 * std::sqrt(98 * 0.09));
  for (const farm::Plot& plot : some.plots) {
    EXPECT_EQ(plot.box.center, all.plots[plot.id - 1].box.center);
    EXPECT_EQ(plot.column, all.plots[plot.id - 1].column);
  }
  EXPECT_EQ(some.plants.size(), 5 * some.plots.size());
  for (std::size_t i = 0; i < some.plants.size(); ++i) {
    const farm::Plant& plant = some.plants[i];
    EXPECT_EQ(plant.id, i + 1);
    EXPECT_TRUE(std::any_of(all.plants.begin(), all.plants.end(), [&](const farm::Plant& other) {
      return other.plot == plant.plot && other.position == plant.position &&
             other.scale == plant.scale;
    }));
  }
}

TEST(SownPlants, AFarmWhosePlotsAreAllMissingIsRefused) {
  EXPECT_THAT(
      message_of<InputError>([] { trial("  count: 5\n", 6, ", missing_rate: 1"); }),
      HasSubstr("trial.yaml: plots: all 100 are missing; a lower missing_rate leaves some"));
}

double highest_vertex(const farm::Farm& farm, const farm::Plant& plant) {
  double highest = -1e9;
  for (const Eigen::Vector3f& vertex : farm.models[plant.model].mesh.vertices) {
    const Eigen::Vector3d placed =
        plant.position + plant.rotation * plant.scale.cwiseProduct(vertex.cast<double>());
    highest = std::max(highest, placed.z());
  }
  return highest - plant.position.z();
}

TEST(SownPlants, PlantsOfALodgedPlotLeanOneWay) {
  const farm::Farm farm = trial(
      "  count: 12\n"
      "  lodging: {plots_rate: 0.3, angle_deg: [30, 70], spread_deg: 5, direction_deg: 200}\n");
  std::map<std::uint32_t, std::vector<double>> leans;
  for (const farm::Plant& plant : farm.plants) {
    const Eigen::Vector3d stem = plant.rotation * Eigen::Vector3d::UnitZ();
    const double lean = std::atan2(stem.head<2>().norm(), stem.z());
    leans[plant.plot].push_back(lean / kDegrees);
    EXPECT_NEAR(plant.height_m, highest_vertex(farm, plant), 1e-9);
    if (lean == 0) continue;
    const Eigen::Vector2d wanted(std::cos(200 * kDegrees), std::sin(200 * kDegrees));
    EXPECT_GE(stem.head<2>().normalized().dot(wanted), std::cos(5 * kDegrees) - 1e-12);
  }
  int lodged = 0;
  for (const farm::Plot& plot : farm.plots) {
    const auto& [least, greatest] =
        std::minmax_element(leans[plot.id].begin(), leans[plot.id].end());
    EXPECT_NEAR(plot.lodging_rad / kDegrees, moments_of(leans[plot.id]).mean, 1e-6);
    if (plot.lodging_rad == 0) continue;
    ++lodged;
    EXPECT_GE(*least, 25 - 1e-6);
    EXPECT_LE(*greatest, 75 + 1e-6);
    EXPECT_LE(*greatest - *least, 10 + 1e-6);
    EXPECT_GT(*greatest - *least, 1);
  }
  EXPECT_NEAR(lodged, 30, 4 * std::sqrt(100 * 0.3 * 0.7));
}

TEST(SownPlants, LodgedPlotsFallEachItsOwnWay) {
  const farm::Farm farm =
      trial("  count: 1\n  lodging: {plots_rate: 1, angle_deg: [45, 45], spread_deg: 0}\n");
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const farm::Plant& plant : farm.plants) {
    const Eigen::Vector3d stem = plant.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(stem.z(), std::cos(45 * kDegrees), 1e-12);
    sum += stem.head<2>().normalized();
  }
  EXPECT_LT(sum.norm(), 4 * std::sqrt(100 / 2.0)) << "uniform directions cancel";
}

TEST(SownPlants, AModelIsNotStretchedWithoutBounds) {
  const std::string tiny =
      "{name: tiny, unit_m: 0.001, mesh: " + (testing::models_folder() / "soybean_1.obj").string() +
      "}";
  const std::string plants =
      "  count: 1\n  cultivars:\n    - {name: a}\n"
      "    - {name: b, height_m: {mean: 1, sd: 0}, models: [" +
      tiny + "]}\n";
  EXPECT_THAT(
      message_of<InputError>([&] { trial(plants); }),
      HasSubstr(
          "trial.yaml: plants.height_m: a plant of b is to be 1.000 m high, but its model tiny"));
}

// A file in centimetres that is read as metres.
TEST(SownPlants, ModelsTallerThanAnyCropAreNoted) {
  const auto notes_of = [](const std::string& unit_m) {
    const std::string model = "{name: one, unit_m: " + unit_m +
                              ", mesh: " + (testing::models_folder() / "soybean_1.obj").string() +
                              "}";
    const farm::Farm farm = trial(
        "  count: 1\n  cultivars:\n    - {name: a}\n"
        "    - {name: b, models: [" +
        model + "]}\n");
    return std::ranges::find(farm.models, "one", &farm::PlantModel::name)->notes;
  };
  EXPECT_THAT(notes_of("1"), ::testing::IsEmpty());
  EXPECT_THAT(notes_of("100"), ::testing::ElementsAre(HasSubstr("more than any crop of a field")));
}

}  // namespace
}  // namespace plotscan::planting
