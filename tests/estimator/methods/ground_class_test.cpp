// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/random.h"
#include "run_on_farm.h"

namespace plotscan::methods {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::SyntheticFarm;

constexpr double kWeeds_m = 0.25;

// A field whose points a surveyor has classified: ground 2, vegetation 3. Weeds cover it so densely
// that one point in a hundred is of the ground.
std::string classified_field(const SyntheticFarm& farm) {
  std::string text = "x,y,z,classification\n";
  RandomStream random(3, random_purpose("test/weeds"), 0);
  for (const Eigen::Vector3d& point : farm.points()) {
    const bool is_low = point.z() == farm.ground_z(point.head<2>());
    const bool is_ground = is_low && random.uniform() < 0.01;
    const double z =
        is_low && !is_ground ? point.z() + kWeeds_m * random.uniform(0.9, 1.1) : point.z();
    text += format_number(point.x()) + ',' + format_number(point.y()) + ',' + format_number(z) +
            (is_ground ? ",2\n" : ",3\n");
  }
  return text;
}

class GroundClass : public ::testing::Test {
 protected:
  GroundClass() {
    options_.cloud = folder_.write("field.csv", classified_field(farm_));
    options_.output = folder_.path() / "estimate";
    options_.replace = true;
    std::vector<PlotFeature> boxes;
    for (const PlotBox& box : farm_.boxes()) boxes.push_back({.box = box});
    options_.boxes = folder_.path() / "boxes.geojson";
    write_plot_features(*options_.boxes, boxes);
  }
  // Of the canopies' tops over the truth.
  std::vector<double> errors_m() const {
    const estimate::Estimate estimate = run(options_);
    std::vector<double> errors;
    const std::vector<double> heights = farm_.heights();
    for (std::size_t i = 0; i < heights.size(); ++i)
      errors.push_back(estimate.plots.at(i).heights_m.at("canopy_p99") - heights[i]);
    return errors;
  }

  const SyntheticFarm farm_{.rows = 2, .columns = 4};
  const TemporaryFolder folder_;
  RunOptions options_;
};

TEST_F(GroundClass, AloneCarriesTheGround) {
  options_.lattice.ground_classes = {2};
  for (const double error_m : errors_m()) EXPECT_NEAR(error_m, 0, 0.05);
  const auto manifest = read_manifest(options_.output);
  EXPECT_EQ(manifest["options"]["ground_classes"], nlohmann::json({2}));
}

// The weeds mislead a ground that every point may carry, and so they do as a class of it.
TEST_F(GroundClass, WithoutItWeedsAreTheGround) {
  for (const std::vector<int>& classes : {std::vector<int>{}, {2, 3}}) {
    options_.lattice.ground_classes = classes;
    for (const double error_m : errors_m()) EXPECT_NEAR(error_m, -kWeeds_m, 0.06);
  }
}

TEST_F(GroundClass, WhatACloudHasNotIsRefused) {
  options_.lattice.ground_classes = {9, 11};
  EXPECT_THAT(message_of<InputError>([&] { run(options_); }),
              HasSubstr("field.csv: no point is of the classes that are to be read: 9, 11"));
  options_.lattice.ground_classes = {2};
  options_.cloud = folder_.write("plain.xyz", "0 0 0\n1 1 1\n2 2 2\n");
  EXPECT_THAT(message_of<InputError>([&] { run(options_); }), HasSubstr("plain.xyz"));
  options_.lattice.ground_classes = {300};
  EXPECT_THAT(message_of<InputError>([&] { run(options_); }),
              HasSubstr("ground_classes 300 must be in [0, 255]"));
}

}  // namespace
}  // namespace plotscan::methods
