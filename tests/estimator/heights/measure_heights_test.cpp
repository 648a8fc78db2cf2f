// SPDX-License-Identifier: Apache-2.0
#include "heights/measure_heights.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopies.h"

namespace plotscan::heights {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

constexpr double kNoise_m = 0.02;

struct Field {
  ground::Surface surface = level_ground(kNoise_m);
  std::vector<PlotBox> boxes;
  std::vector<std::vector<Eigen::Vector3f>> returns;

  std::vector<PlotHeights> measured(bool calibrated = true, int threads = 1) const {
    std::vector<PlotPoints> plots;
    for (std::size_t i = 0; i < boxes.size(); ++i) plots.push_back({boxes[i], returns[i]});
    return measure_heights(plots, surface, {.calibrated = calibrated, .threads = threads}).plots;
  }
};

Field domes(int plots, double scale = 1, int returns = 18'000) {
  Field field;
  for (int i = 0; i < plots; ++i) {
    field.boxes.push_back(plot_at(2.5 * (i % 3) - 2.5, 5.0 * (i / 3) - 2.5));
    field.returns.push_back(dome_returns(field.boxes.back(), scale, kNoise_m, returns,
                                         static_cast<std::uint64_t>(100 + i)));
  }
  return field;
}

TEST(MeasureHeights, NamesAllHeightsInTheirOrder) {
  for (const bool calibrated : {true, false}) {
    const std::vector<PlotHeights> plots = domes(4).measured(calibrated);
    ASSERT_FALSE(plots.empty());
    for (const PlotHeights& plot : plots) {
      const auto value = [&](const char* name) { return plot.heights.at(name).value_m; };
      EXPECT_EQ(plot.heights.size(), 8);
      EXPECT_LT(value("mean"), value("p95"));
      EXPECT_LT(value("p50"), value("p90"));
      EXPECT_LE(value("p95"), value("p99"));
      EXPECT_LT(value("p95"), value("max"));
      EXPECT_LT(value("canopy_p95"), value("canopy_p99"));
      for (const auto& [name, height] : plot.heights) {
        EXPECT_LT(height.low95_m, height.value_m) << name;
        EXPECT_GT(height.high95_m, height.value_m) << name;
        EXPECT_GT(height.standard_error_m, 0) << name;
      }
    }
  }
}

// Whatever the canopy and however few the returns: no percentile over a higher one.
TEST(MeasureHeights, KeepsTheHeightsInTheirOrder) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    RandomStream random(seed, random_purpose("test/order"), 0);
    Field field = domes(3, random.uniform(0.1, 3), 100 + static_cast<int>(random.below(3000)));
    for (std::vector<Eigen::Vector3f>& returns : field.returns) {
      const auto power = static_cast<float>(random.uniform(0.2, 3));
      for (Eigen::Vector3f& point : returns)
        point.z() =
            std::pow(std::max(0.0F, point.z()), power) + 0.3F * static_cast<float>(random.below(2));
    }
    for (const PlotHeights& plot : field.measured()) {
      const auto value = [&](const char* name) { return plot.heights.at(name).value_m; };
      EXPECT_LE(value("p50"), value("p90")) << seed;
      EXPECT_LE(value("p90"), value("p95")) << seed;
      EXPECT_LE(value("p95"), value("p99")) << seed;
      EXPECT_LE(value("p99"), value("max")) << seed;
      EXPECT_LE(value("mean"), value("max")) << seed;
      EXPECT_LE(value("canopy_p95"), value("canopy_p99")) << seed;
    }
  }
}

TEST(MeasureHeights, IsTheSameForAnyNumberOfThreads) {
  const Field field = domes(6);
  const std::vector<PlotHeights> one = field.measured(true, 1);
  const std::vector<PlotHeights> three = field.measured(true, 3);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(three.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].heights.size(), 8);
    for (const auto& [name, height] : one[i].heights) {
      EXPECT_EQ(height.value_m, three[i].heights.at(name).value_m);
      EXPECT_EQ(height.standard_error_m, three[i].heights.at(name).standard_error_m);
    }
  }
}

TEST(MeasureHeights, FlagsFewReturns) {
  Field field = domes(4);
  field.returns[1].resize(80);
  const std::vector<PlotHeights> plots = field.measured();
  EXPECT_THAT(plots[0].flags, Not(Contains("too few returns")));
  EXPECT_THAT(plots[1].flags, Contains("too few returns"));
}

TEST(MeasureHeights, FlagsAPlotWithoutReturns) {
  Field field = domes(3);
  field.returns[2].clear();
  const std::vector<PlotHeights> plots = field.measured();
  EXPECT_THAT(plots[2].heights, IsEmpty());
  EXPECT_THAT(plots[2].flags, Contains("too few returns"));
  EXPECT_THAT(plots[2].flags, Not(Contains("canopy is too low to measure")));
}

// Most of the plots failed: the others are measured as if these were not there.
TEST(MeasureHeights, PlotsWithoutACropMoveNoOthers) {
  Field field = domes(7);
  Field bare = field;
  for (std::size_t i = 3; i < 7; ++i)
    for (Eigen::Vector3f& point : bare.returns[i]) point.z() *= 0.001F;
  field.boxes.resize(3);
  field.returns.resize(3);
  const std::vector<PlotHeights> alone = field.measured(), among = bare.measured();
  for (std::size_t i = 0; i < 3; ++i) {
    for (const auto& [name, height] : alone[i].heights)
      EXPECT_EQ(among[i].heights.at(name).value_m, height.value_m) << name;
  }
  EXPECT_THAT(among[3].flags, Contains("canopy is too low to measure"));
}

TEST(MeasureHeights, FlagsAPlotThatTheSurveyCuts) {
  Field field = domes(4);
  std::erase_if(field.returns[3], [&](const Eigen::Vector3f& point) {
    return field.boxes[3].box_from_world(point.head<2>().cast<double>()).x() > 1;
  });
  const std::vector<PlotHeights> plots = field.measured();
  EXPECT_THAT(plots[2].flags, Not(Contains("part of the plot was not scanned")));
  EXPECT_THAT(plots[3].flags, Contains("part of the plot was not scanned"));
}

// The first plot's right side under leaves of a plot twice as tall: its plants are measured as they
// would be alone, its canopy is what hangs over it.
TEST(MeasureHeights, PlantsOfATallerPlotBesideItDoNotCount) {
  Field field = domes(4);
  field.boxes.resize(2);
  field.returns.resize(2);
  const PlotHeights alone = field.measured()[0];
  field.boxes[1].center = field.boxes[0].center + 1.5 * field.boxes[0].width_axis();
  field.returns[1] = dome_returns(field.boxes[1], 2, kNoise_m, 18'000, 7);
  for (const Eigen::Vector3f& point : field.returns[1]) {
    const Eigen::Vector2d moved =
        point.head<2>().cast<double>() - 0.3 * field.boxes[0].width_axis();
    if (field.boxes[0].contains(moved))
      field.returns[0].emplace_back(moved.x(), moved.y(), point.z());
  }
  const PlotHeights beside = field.measured()[0];
  EXPECT_THAT(beside.flags, Contains("plants of a taller plot beside it reach into it"));
  EXPECT_THAT(alone.flags, Not(Contains("plants of a taller plot beside it reach into it")));
  for (const char* name : {"max", "p95", "mean"})
    EXPECT_NEAR(beside.heights.at(name).value_m, alone.heights.at(name).value_m, 0.05) << name;
  EXPECT_GT(beside.heights.at("canopy_p99").value_m, alone.heights.at("max").value_m + 0.2);
}

TEST(MeasureHeights, FlagsGroundThatIsUnsureOrAbsent) {
  Field field = domes(3);
  std::ranges::fill(field.surface.sd_m, 0.05F);
  for (const PlotHeights& plot : field.measured())
    EXPECT_THAT(plot.flags, Contains("ground is unsure by centimetres"));
  std::ranges::fill(field.surface.z_m, NAN);
  std::ranges::fill(field.surface.sd_m, NAN);
  for (const PlotHeights& plot : field.measured())
    EXPECT_THAT(plot.flags, Contains("no ground within reach"));
}

// A crease under one corner of one plot.
TEST(MeasureHeights, FlagsTheWorstGroundInAPlot) {
  Field field = domes(3);
  const Eigen::Vector2d corner = field.boxes[1].corners()[0];
  const Eigen::Vector2d node =
      (0.8 * corner + 0.2 * field.boxes[1].center - field.surface.origin) / field.surface.cell_m;
  const int at = std::lround(node.y()) * field.surface.columns + std::lround(node.x());
  for (const int near :
       {at, at + 1, at - 1, at + field.surface.columns, at - field.surface.columns})
    field.surface.sd_m[static_cast<std::size_t>(near)] = 0.06F;
  const std::vector<PlotHeights> plots = field.measured();
  EXPECT_THAT(plots[0].flags, Not(Contains("ground is unsure by centimetres")));
  EXPECT_THAT(plots[1].flags, Contains("ground is unsure by centimetres"));
}

// A third of the plot stands on a table: no crop is like that.
TEST(MeasureHeights, FlagsPlantsUnlikeThoseKnown) {
  Field field = domes(4);
  const double usual = field.measured()[1].heights.at("p95").standard_error_m;
  for (Eigen::Vector3f& point : field.returns[1])
    if (field.boxes[1].box_from_world(point.head<2>().cast<double>()).x() > 0.7) point.z() += 4;
  const std::vector<PlotHeights> plots = field.measured();
  EXPECT_THAT(plots[0].flags, Not(Contains("plants unlike those the calibration knows")));
  EXPECT_THAT(plots[1].flags, Contains("plants unlike those the calibration knows"));
  EXPECT_GT(plots[1].heights.at("p95").standard_error_m, 1.5 * usual);
}

// Without calibration the standard errors are shares of the top, known here: some over 2.5 cm.
TEST(MeasureHeights, FlagsEachHeightWhoseIntervalIsWide) {
  const std::vector<PlotHeights> plots = domes(4).measured(false);
  ASSERT_FALSE(plots.empty());
  for (const PlotHeights& plot : plots) {
    EXPECT_THAT(plot.flags, Contains("mean height is unsure by centimetres"));
    EXPECT_THAT(plot.flags, Not(Contains("canopy_p99 height is unsure by centimetres")));
    for (const auto& [name, height] : plot.heights)
      EXPECT_EQ(std::ranges::count(plot.flags, name + " height is unsure by centimetres"),
                height.standard_error_m > 0.025 ? 1 : 0)
          << name;
  }
}

TEST(MeasureHeights, AnUnsureGroundWidensTheIntervals) {
  Field field = domes(3);
  const double sure = field.measured()[0].heights.at("p95").standard_error_m;
  std::ranges::fill(field.surface.sd_m, 0.05F);
  EXPECT_NEAR(field.measured()[0].heights.at("p95").standard_error_m, std::hypot(sure, 0.05),
              0.002);
}

TEST(MeasureHeights, TwoLayersOfGroundWidenTheIntervals) {
  Field field = domes(3);
  const double sure = field.measured()[0].heights.at("p95").standard_error_m;
  field.surface.layers_m.assign(field.surface.z_m.size(), 0.04F);
  const PlotHeights plot = field.measured()[0];
  EXPECT_NEAR(plot.heights.at("p95").standard_error_m, std::hypot(sure, 0.04), 0.002);
  EXPECT_THAT(plot.flags, Contains("ground is unsure by centimetres"));
}

TEST(MeasureHeights, FlagsWhatIsTooLowToBeACrop) {
  for (const PlotHeights& plot : domes(3, 0.05).measured())
    EXPECT_THAT(plot.flags, Contains("canopy is too low to measure"));
}

}  // namespace
}  // namespace plotscan::heights
