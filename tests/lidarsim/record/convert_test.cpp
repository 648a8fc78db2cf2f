// SPDX-License-Identifier: Apache-2.0
#include "record/convert.h"

#include <fstream>

#include "lidarsim/lidar/small_farm.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "lidar/fly.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

class Convert : public ::testing::Test {
 protected:
  Convert() { lidar::fly(testing::small_farm(), scan_, {}, false); }

  std::string refusal(const fs::path& in, const std::string& out,
                      const ConvertOptions& options = {}) {
    return message_of<InputError>([&] { convert(in, folder_.path() / out, options); });
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_.path()), {}); }

  TemporaryFolder folder_;
  const fs::path scan_ = folder_.path() / "scan";
};

TEST_F(Convert, PcdComesBackByteForByte) {
  const fs::path out = folder_.path() / "out.pcd";
  const ConvertSummary summary = convert(scan_, out, {});
  EXPECT_EQ(summary.points, read_manifest(scan_)["results"]["points"]);
  EXPECT_EQ(file_hash(out), file_hash(scan_ / "cloud.pcd"));
}

TEST_F(Convert, TrajectoriesGoToTumAndBack) {
  const fs::path tum = folder_.path() / "flight.tum";
  const fs::path back = folder_.path() / "back.csv";
  EXPECT_GT(convert(scan_ / "trajectory.csv", tum, {}).poses, 100u);
  convert(tum, back, {});
  EXPECT_EQ(file_hash(back), file_hash(scan_ / "trajectory.csv"));
  std::ifstream text(tum);
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "# t x y z qx qy qz qw");
  std::getline(text, line);
  EXPECT_EQ(std::count(line.begin(), line.end(), ' '), 7);
  convert(scan_, folder_.path() / "reported.csv", {});
  EXPECT_EQ(file_hash(folder_.path() / "reported.csv"), file_hash(scan_ / "poses.csv"));
}

TEST_F(Convert, WhatCannotBeIsRefusedAndLeavesNothing) {
  folder_.write("taken.pcd", "x");
  folder_.write("text.xyz", "1 2 3\n");
  const auto before = files();
  EXPECT_THAT(refusal(scan_, "out.xyz"), HasSubstr("must end in one of .pcd"));
  EXPECT_THAT(refusal(scan_, "taken.pcd"), HasSubstr("--force"));
  EXPECT_THAT(refusal(scan_, "none/out.pcd"), HasSubstr("no such folder"));
  EXPECT_THAT(refusal(folder_.path() / "absent.pcd", "out.pcd"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_.path() / "text.xyz", "out.pcd"), HasSubstr("neither"));
  EXPECT_THAT(refusal(folder_.path(), "out.pcd"), HasSubstr("no manifest.json"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.tum"), HasSubstr("no trajectory"));
  EXPECT_THAT(refusal(scan_ / "poses.csv", "out.pcd"), HasSubstr("is a trajectory"));
  EXPECT_THAT(refusal(scan_, "out.pcd", {.flight = FlightOptions{}}), HasSubstr("by itself"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.pcd", {.flight = FlightOptions{}}),
              HasSubstr("only with --trajectory"));
  EXPECT_EQ(files(), before);
}

TEST_F(Convert, ABareCloudTakesItsFlightFromTheOptions) {
  const FlightOptions flight{.trajectory = scan_ / "poses.csv"};
  convert(scan_ / "cloud.pcd", folder_.path() / "out.csv", {.flight = flight});
  EXPECT_EQ(file_hash(folder_.path() / "out.csv"), file_hash(scan_ / "poses.csv"));
  FlightOptions wrong = flight;
  wrong.spin_hz = 50;
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.pcd", {.flight = wrong}), HasSubstr("--spin 50"));
  wrong = flight;
  wrong.start_utc = "noon";
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.pcd", {.flight = wrong}), HasSubstr("--start"));
}

}  // namespace
}  // namespace plotscan::record
