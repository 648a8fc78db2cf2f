// SPDX-License-Identifier: Apache-2.0
#include "estimate/run.h"

#include <cstring>
#include <fstream>

#include "synthetic_farm.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"

namespace plotscan::estimate {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::SyntheticFarm;

// A binary PCD written by the test, with labels that an estimator must not need.
fs::path write_cloud(const fs::path& file, const std::vector<Eigen::Vector3d>& points) {
  const std::string count = std::to_string(points.size());
  std::string body = "VERSION 0.7\nFIELDS x y z plot\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n";
  body +=
      "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f xyz = point.cast<float>();
    const std::uint32_t label = 7;
    char record[16];
    std::memcpy(record, xyz.data(), 12);
    std::memcpy(record + 12, &label, 4);
    body.append(record, sizeof record);
  }
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << body;
  return file;
}

RunOptions small_run(const TemporaryFolder& folder, const SyntheticFarm& farm) {
  RunOptions options{.cloud = write_cloud(folder.path() / "scan" / "cloud.pcd", farm.points()),
                     .output = folder.path() / "estimate"};
  options.method = "dhami2020";
  options.dhami2020.plots = 8;
  return options;
}

const SyntheticFarm kFarm{.rows = 2, .columns = 4};

TEST(Run, WritesAFolderFromWhichTheRunCanBeRepeated) {
  const TemporaryFolder folder;
  const RunOptions options = small_run(folder, kFarm);
  const Estimate estimate = run(options);
  EXPECT_EQ(estimate.plots.size(), 8u);
  const Estimate read = read_estimate(options.output);
  EXPECT_EQ(read.method, "dhami2020");
  ASSERT_EQ(read.plots.size(), 8u);
  EXPECT_EQ(read.plots[3].heights_m, estimate.plots[3].heights_m);
  const auto manifest = read_manifest(options.output);
  EXPECT_EQ(manifest["command"], "estimator run");
  EXPECT_EQ(manifest["options"]["plots"], 8);
  EXPECT_EQ(manifest["inputs"][0]["hash"], file_hash(options.cloud));
  EXPECT_EQ(manifest["results"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["heights"]["raw-max"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["diagnostics"]["votes"]["clusters"], 8);
}

TEST(Run, TakesAScanFolderAndGivesTheSameBytes) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  run(options);
  const std::string first = read_text(options.output / "manifest.json");
  options.cloud = folder.path() / "scan";
  options.threads = 2;
  options.replace = true;
  run(options);
  EXPECT_EQ(read_text(options.output / "manifest.json"), first);
}

TEST(Run, KeepsTheNamesOfGivenPlots) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.dhami2020.plots = 0;
  options.boxes = folder.path() / "plots.geojson";
  write_plot_features(
      *options.boxes,
      {{kFarm.box(1, 2), {{"plot_number", 42}, {"row_number", 2}, {"col_number", 3}}},
       {kFarm.box(0, 0), nlohmann::json::object()}});
  const Estimate estimate = run(options);
  ASSERT_EQ(estimate.plots.size(), 2u);
  EXPECT_EQ(estimate.plots[0].id, 42u);
  EXPECT_EQ(estimate.plots[0].row, 2);
  EXPECT_EQ(estimate.plots[0].column, 3);
  EXPECT_EQ(estimate.plots[1].id, 2u);
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-4);
  EXPECT_NEAR(estimate.plots[1].heights_m.at("raw-max"), kFarm.height_m(0, 0), 1e-4);
}

TEST(Run, LeavesNothingBehindOnBadInput) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  options.method = "magic";
  EXPECT_THAT(message(), HasSubstr("no method \"magic\""));
  options.method = "dhami2020";
  options.dhami2020.plots = 0;
  EXPECT_THAT(message(), HasSubstr("number of plots"));
  options.boxes = folder.write("none.geojson", R"({"features":[]})");
  EXPECT_THAT(message(), HasSubstr("has no plots"));
  options.cloud = folder.path() / "missing.pcd";
  EXPECT_THAT(message(), HasSubstr("missing.pcd"));
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::AnyOf("scan", "none.geojson"));
  }
}

}  // namespace
}  // namespace plotscan::estimate
