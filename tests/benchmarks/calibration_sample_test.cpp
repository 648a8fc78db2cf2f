// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/field_sample.h"
#include "calibration/measured_field.h"
#include "calibration/perfect_returns.h"
#include "core/error.h"
#include "core/random.h"
#include "heights/features.h"
#include "lidarsim/lidar/small_farm.h"
#include "temporary_folder.h"

namespace plotscan::calibration {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// Two plots of 2 x 2 m on level ground, 1,000 returns a square metre between the ground and 0.6 m.
FieldSample sample_of_two_plots(std::uint64_t seed) {
  RandomStream random(seed, random_purpose("test/calibration_sample"), 0);
  FieldSample sample{.library = "wheat-a", .seed = seed};
  sample.surface = {{.origin = {-4, -4}, .cell_m = 0.5, .columns = 25, .rows = 17}};
  sample.surface.z_m.assign(25 * 17, 0);
  sample.surface.sd_m.assign(25 * 17, 0.003F);
  sample.surface.seen.assign(25 * 17, 1);
  sample.surface.noise_m = 0.01;
  for (int plot = 0; plot < 2; ++plot) {
    const Eigen::Vector2d center(4.0 * plot, 0.5);
    PlotSample one{.box = {.center = center, .width_m = 2, .length_m = 2, .heading_rad = 0.3},
                   .truth = {{"max", 0.7 + 0.1 * plot}, {"mean", 0.6}}};
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector2d place = center + random.uniform(-1, 1) * one.box.length_axis() +
                                    random.uniform(-1, 1) * one.box.width_axis();
      one.points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()),
                              static_cast<float>(random.uniform(0, 0.6)));
    }
    one.perfect.assign(one.points.begin(), one.points.begin() + 1000);
    sample.plots.push_back(one);
  }
  return sample;
}

TEST(SampleFile, ComesBack) {
  const TemporaryFolder folder;
  const FieldSample written = sample_of_two_plots(7);
  write_sample(folder.path() / "sample", written);
  const FieldSample read = read_sample(folder.path() / "sample");
  EXPECT_EQ(read.library, written.library);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.surface.origin, written.surface.origin);
  EXPECT_EQ(read.surface.cell_m, written.surface.cell_m);
  EXPECT_EQ(read.surface.columns, written.surface.columns);
  EXPECT_EQ(read.surface.rows, written.surface.rows);
  EXPECT_EQ(read.surface.noise_m, written.surface.noise_m);
  EXPECT_EQ(read.surface.z_m, written.surface.z_m);
  EXPECT_EQ(read.surface.sd_m, written.surface.sd_m);
  EXPECT_EQ(read.surface.seen, written.surface.seen);
  ASSERT_EQ(read.plots.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.plots[i].box.center, written.plots[i].box.center);
    EXPECT_EQ(read.plots[i].box.width_m, written.plots[i].box.width_m);
    EXPECT_EQ(read.plots[i].box.length_m, written.plots[i].box.length_m);
    EXPECT_EQ(read.plots[i].box.heading_rad, written.plots[i].box.heading_rad);
    EXPECT_EQ(read.plots[i].truth, written.plots[i].truth);
    EXPECT_EQ(read.plots[i].points, written.plots[i].points);
    EXPECT_EQ(read.plots[i].perfect, written.plots[i].perfect);
  }
}

TEST(SampleFile, OneThatEndsTooEarlyIsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "sample";
  write_sample(file, sample_of_two_plots(7));
  const std::uintmax_t whole = std::filesystem::file_size(file);
  for (const double share : {0.999, 0.7, 0.5, 0.01}) {
    std::filesystem::resize_file(file,
                                 static_cast<std::uintmax_t>(share * static_cast<double>(whole)));
    EXPECT_THAT(message_of<InputError>([&] { read_sample(file); }), HasSubstr("ends too early"))
        << share;
  }
  std::filesystem::resize_file(file, 20);
  EXPECT_THAT(message_of<InputError>([&] { read_sample(file); }), HasSubstr("is not a sample"));
}

// A count of 2^64 - 1 nodes of the ground, and lines that describe no field.
TEST(SampleFile, WhatIsNoSampleIsRefused) {
  const TemporaryFolder folder;
  write_sample(folder.path() / "sample", sample_of_two_plots(7));
  std::ifstream in(folder.path() / "sample", std::ios::binary);
  std::string line;
  std::getline(in, line);
  const auto refusal = [&](const std::string& content) {
    const std::filesystem::path file = folder.write("other", content);
    return message_of<InputError>([&] { read_sample(file); });
  };
  EXPECT_THAT(refusal(line + "\n" + std::string(64, '\xff')), HasSubstr("ends too early"));
  EXPECT_THAT(refusal("# a readme\n"), HasSubstr("is not a sample"));
  EXPECT_THAT(refusal("{\"library\": \"wheat-a\"}\n"), HasSubstr("is not a sample"));
  EXPECT_THAT(refusal("[1, 2]\n"), HasSubstr("is not a sample"));
}

TEST(MeasureSample, PerfectReturnsAreMeasuredAsTheyAre) {
  const FieldSample sample = sample_of_two_plots(7);
  const MeasuredField field = measure(sample, Returns::perfect);
  EXPECT_EQ(field.library, "wheat-a");
  ASSERT_EQ(field.plots.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const PlotSample& plot = sample.plots[i];
    const heights::CanopyFeatures seen = heights::see_canopy(plot.box, plot.perfect, 0, 0).features;
    EXPECT_EQ(field.plots[i].top_m, seen.top_m);
    EXPECT_EQ(field.plots[i].features, seen.values);
    EXPECT_EQ(field.plots[i].truth, plot.truth);
    EXPECT_EQ(ratios_of(field.plots[i], {"mean", "max"})(0), 0.6 / seen.top_m);
    EXPECT_EQ(ratios_of(field.plots[i], {"mean", "max"})(1), plot.truth.at("max") / seen.top_m);
  }
}

TEST(MeasureSample, PlotsWithoutACanopyAreLeftOut) {
  FieldSample sample = sample_of_two_plots(7);
  for (Eigen::Vector3f& point : sample.plots[0].points) point.z() *= 0.05F;
  sample.plots[1].points.clear();
  EXPECT_TRUE(measure(sample, Returns::thinned).plots.empty());
}

// All returns of half of the farms, of the others down to a thirtieth; 100 a square metre at the
// least. (One of the features is the logarithm of the returns' density.)
TEST(MeasureSample, HalfOfTheFarmsAreThinned) {
  const std::vector<std::string>& names = heights::feature_names();
  const auto density = std::ranges::find(names, "density") - names.begin();
  ASSERT_LT(density, std::ssize(names));
  int whole = 0, below_third = 0;
  constexpr int kFarms = 60;
  for (std::uint64_t seed = 0; seed < kFarms; ++seed) {
    const MeasuredField field = measure(sample_of_two_plots(seed), Returns::thinned);
    ASSERT_EQ(field.plots.size(), 2U);
    const double density_m2 = std::exp(field.plots[0].features(density));
    EXPECT_GT(density_m2, 60) << seed;
    EXPECT_LE(density_m2, 1001) << seed;
    whole += density_m2 > 999 ? 1 : 0;
    below_third += density_m2 < 333 ? 1 : 0;
  }
  EXPECT_NEAR(whole, kFarms / 2, 10);
  EXPECT_GT(below_third, kFarms / 8);
}

// A plate of 0.4 x 0.62 m at a height of 0.5 m in the middle of a plot that is turned.
TEST(PerfectReturns, AreWhatStandsThereOverItsWholeArea) {
  farm::Farm farm{.name = "one",
                  .terrain = testing::flat_terrain(20, 3),
                  .models = {{.name = "plate",
                              .mesh = {.vertices = {{-0.31F, -0.2F, 0.5F},
                                                    {0.31F, -0.2F, 0.5F},
                                                    {0.31F, 0.2F, 0.5F},
                                                    {-0.31F, 0.2F, 0.5F}},
                                       .triangles = {{0, 1, 2}, {0, 2, 3}},
                                       .materials = {{.name = "leaf"}},
                                       .triangle_material = {0, 0}},
                              .height_m = 0.5}},
                  .plots = {},
                  .plants = {}};
  const PlotBox box{.center = {2, -1}, .width_m = 1, .length_m = 1.5, .heading_rad = 0.6};
  farm.plots.push_back(
      {.id = 1, .row = 1, .column = 1, .box = box, .plant_count = 1, .heights = {}});
  farm.plants.push_back({.id = 1,
                         .plot = 1,
                         .position = {2, -1, 3},
                         .rotation = Eigen::Quaterniond(
                             Eigen::AngleAxisd(box.heading_rad, Eigen::Vector3d::UnitZ()))});
  const std::vector<std::vector<Eigen::Vector3f>> returns = perfect_returns(farm);
  ASSERT_EQ(returns.size(), 1U);
  EXPECT_EQ(returns[0].size(), 50U * 75U);
  std::size_t on_plate = 0;
  for (const Eigen::Vector3f& point : returns[0]) {
    const Eigen::Vector2d place = box.box_from_world(point.head<2>().cast<double>()).cwiseAbs();
    const bool inside = place.x() < 0.31 && place.y() < 0.2;
    on_plate += inside ? 1 : 0;
    ASSERT_NEAR(point.z(), inside ? 0.5 : 0, 1e-5) << place.transpose();
  }
  EXPECT_EQ(on_plate, 31U * 20U);
}

}  // namespace
}  // namespace plotscan::calibration
