// SPDX-License-Identifier: Apache-2.0
#include "record/convert.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/manifest.h"
#include "lidar/fly.h"
#include "lidarsim/record/convert_fixture.h"
#include "lidarsim/scan/foreign_las.h"
#include "scan/cloud_system.h"
#include "scan/cloud_writer.h"
#include "scan/las_crs.h"
#include "scan/las_writer.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A line of /proc/self/status in kilobytes.
long status_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
  return 0;
}

TEST_F(Convert, PcdComesBackByteForByte) {
  const fs::path out = folder_.path() / "out.pcd";
  const ConvertSummary summary = convert(scan_, out, {});
  EXPECT_EQ(summary.points, read_manifest(scan_)["results"]["points"]);
  EXPECT_EQ(file_hash(out), file_hash(scan_ / "cloud.pcd"));
}

// From a scan to every cloud format, and from each on to the next: the same points, but for LAS'
// steps.
TEST_F(Convert, EveryCloudFormatHoldsEveryField) {
  struct Kind {
    const char* extension;
    const char* encoding;
  };
  const std::vector<Kind> kinds = {{".pcd", "binary"}, {".pcd", "compressed"}, {".pcd", "ascii"},
                                   {".ply", "binary"}, {".ply", "ascii"},      {".las", ""}};
  const auto original = points_of(scan_ / "cloud.pcd");
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Kind& first = kinds[i];
    const Kind& second = kinds[(i + 1) % kinds.size()];
    const fs::path one = folder_.path() / (std::string("one") + first.extension);
    convert(scan_, one, {.write = {.encoding = first.encoding}, .replace = true});
    expect_same(points_of(one), original);
    const fs::path two = folder_.path() / (std::string("two") + second.extension);
    convert(one, two, {.write = {.encoding = second.encoding}, .replace = true});
    expect_same(points_of(two), original);
  }
}

TEST_F(Convert, LasSaysWhenFromWhereAndHowThePointsWereMeasured) {
  const fs::path las = folder_.path() / "cloud.las";
  convert(scan_, las, {});
  EXPECT_EQ(format_utc(scan::read_cloud_info(las).start.value()), "2026-06-01T10:00:00Z");
  EXPECT_THAT(read_text(las), HasSubstr("Velodyne VLP-16"));
  EXPECT_THAT(refusal(scan_, "utm.las", {.write = {.crs = "utm"}}), HasSubstr("has an anchor"));
}

// The points of an anchored farm, against the plain geodesy of core.
TEST_F(Convert, AnAnchoredFarmsLasMayBeInUtm) {
  const Anchor anchor{.latitude_deg = 37.2, .longitude_deg = -80.5, .altitude_m = 610};
  farm::Farm farm = testing::small_farm();
  farm.anchor = anchor;
  lidar::fly(farm, folder_.path() / "anchored", {});
  const fs::path las = folder_.path() / "utm.las";
  convert(folder_.path() / "anchored", las, {.write = {.crs = "utm"}});
  EXPECT_THAT(scan::read_cloud_info(las).crs_wkt, HasSubstr("WGS 84 / UTM zone 17N"));
  const auto local = points_of(folder_.path() / "anchored" / "cloud.pcd");
  std::size_t i = 0;
  scan::read_positions(las, [&](std::span<const Eigen::Vector3d> positions) {
    for (const Eigen::Vector3d& position : positions) {
      const auto& p = local.at(i++);
      const auto place = geodetic_from_world(anchor, {p.x, p.y, p.z});
      ASSERT_LT((position - utm_from_geodetic(utm_zone(anchor), place)).norm(), 1e-4);
    }
  });
  EXPECT_EQ(i, local.size());
}

// 111 MB of points.
TEST_F(Convert, MemoryDoesNotGrowWithTheCloud) {
  const fs::path big = folder_.path() / "big.pcd";
  scan::PcdWriter writer(big);
  for (int i = 0; i < 3000; ++i) writer.write(std::vector<scan::LabelledPoint>(1000));
  writer.close();
  for (const char* out : {"out.las", "out.ply", "out.pcd"}) {
    std::ofstream("/proc/self/clear_refs") << 5;  // forget the most memory so far
    const long before_kb = status_kb("VmRSS");
    EXPECT_EQ(convert(big, folder_.path() / out, {}).points, 3000000u);
    EXPECT_LT(status_kb("VmHWM") - before_kb, 32000) << out;
  }
}

TEST_F(Convert, TrajectoriesGoToTumAndBack) {
  const fs::path tum = folder_.path() / "flight.tum";
  const fs::path back = folder_.path() / "back.csv";
  EXPECT_GT(convert(scan_ / "trajectory.csv", tum, {}).poses, 100u);
  convert(tum, back, {});
  EXPECT_EQ(file_hash(back), file_hash(scan_ / "trajectory.csv"));
  convert(tum, folder_.path() / "LOUD.TUM", {});
  EXPECT_EQ(file_hash(folder_.path() / "LOUD.TUM"), file_hash(tum));
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
  fs::create_directory(folder_.path() / "empty");
  folder_.write("taken.pcd", "x");
  folder_.write("archive.xyz", "PK\x03\x04");
  const auto before = files();
  EXPECT_THAT(refusal(scan_, "out.ply", {.write = {.encoding = "compressed"}}),
              HasSubstr("there are binary, ascii"));
  EXPECT_THAT(refusal(scan_, "out.las", {.write = {.encoding = "ascii"}}), HasSubstr("but one"));
  EXPECT_THAT(refusal(scan_, "out.pcd", {.write = {.crs = "utm"}}), HasSubstr("for LAS"));
  EXPECT_THAT(refusal(scan_, "out.las", {.write = {.crs = "moon"}}), HasSubstr("local or utm"));
  EXPECT_THAT(refusal(scan_, "out.xyz"), HasSubstr("/out.xyz: cannot be written: its name must "
                                                   "end in one of .pcd"));
  if (find_format("out.laz") == nullptr) {
    EXPECT_THAT(refusal(scan_, "out.laz"), HasSubstr("liblaszip-dev"));
  }
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.bag"), HasSubstr("/out.bag: a ROS 1 bag needs"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.las", {.write = {.crs = "utm"}}),
              HasSubstr("/out.las: --crs utm needs the farm's place on Earth"));
  EXPECT_THAT(refusal(scan_, "taken.pcd"), HasSubstr("--force"));
  EXPECT_THAT(refusal(scan_, "none/out.pcd"), HasSubstr("no such folder"));
  EXPECT_THAT(refusal(folder_.path() / "absent.pcd", "out.pcd"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_.path() / "archive.xyz", "out.pcd"), HasSubstr("neither"));
  EXPECT_THAT(refusal(folder_.path() / "empty", "out.pcd"), HasSubstr("no manifest.json"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.tum"), HasSubstr("no trajectory"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.TXT"),
              HasSubstr("/cloud.pcd: holds points but no trajectory; .txt is a trajectory's here; "
                        "points are written into a file whose name ends in one of .pcd, .ply"));
  EXPECT_THAT(refusal(scan_ / "poses.csv", "out.pcd"),
              HasSubstr("is a trajectory by its extension"));
  EXPECT_THAT(refusal(scan_, "out.pcd", {.flight = FlightOptions{}}), HasSubstr("by itself"));
  EXPECT_THAT(refusal(scan_, "out.tum", {.flight = FlightOptions{}}), HasSubstr("by itself"));
  EXPECT_THAT(refusal(scan_, "out.tum", {.topic = "/x"}), HasSubstr("no topics"));
  EXPECT_THAT(refusal(scan_, "out.tum", {.write = {.crs = "utm"}}), HasSubstr("are for clouds"));
  EXPECT_THAT(refusal(scan_, "out.csv", {.write = {.encoding = "ascii"}}),
              HasSubstr("are for clouds"));
  EXPECT_THAT(refusal(scan_ / "poses.csv", "out.tum", {.flight = FlightOptions{}}),
              HasSubstr("poses.csv: is a trajectory"));
  EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.pcd", {.flight = FlightOptions{}}),
              HasSubstr("only with --trajectory"));
  for (const fs::path& in : {scan_, scan_ / "cloud.pcd"}) {
    ConvertOptions forced;
    forced.replace = true;
    EXPECT_THROW(convert(in, scan_ / "cloud.pcd", forced), InputError) << in;
  }
  EXPECT_EQ(files(), before);
}

// A map in US survey feet by GeoTIFF keys, as older LAS have them, stays in feet.
TEST_F(Convert, LasToLasKeepsTheUnits) {
  const std::array<std::uint16_t, 12> keys = {1, 1, 0, 2, 3072, 0, 1, 2264, 3076, 0, 1, 9003};
  const std::string record = scan::record(
      "LASF_Projection", 34735, {reinterpret_cast<const char*>(keys.data()), sizeof keys});
  const fs::path feet = folder_.write(
      "feet.las", scan::bytes_of({.records = record, .record_count = 1}, {{{1000, 2000, 3000}}}));
  const fs::path out = folder_.path() / "out.las";
  convert(feet, out, {});
  EXPECT_EQ(scan::read_cloud_system(out).units, scan::read_cloud_system(feet).units);
  EXPECT_EQ(scan::crs_name(scan::read_cloud_system(out).crs), "EPSG:2264");
  EXPECT_THAT(refusal(feet, "local.las", {.write = {.crs = "local"}}),
              HasSubstr("states EPSG:2264, which is kept"));
  EXPECT_NO_THROW(convert(scan_, folder_.path() / "local.las", {.write = {.crs = "local"}}));
}

// A cloud of others is not at the centre of a farm of ours.
TEST_F(Convert, NamesTheWorldFrameOfOurScansAlone) {
  const auto system_of = [&](const fs::path& cloud) {
    const fs::path out = folder_.path() / "out.las";
    convert(cloud, out, {.replace = true});
    return scan::crs_name(scan::read_cloud_system(out).crs);
  };
  EXPECT_EQ(system_of(scan_), "Plotscan world frame");
  const fs::path others = folder_.path() / "others.ply";
  convert(scan_, others, {});
  EXPECT_EQ(system_of(others), "unknown");
  convert(others, folder_.path() / "again.las", {});
  EXPECT_NO_THROW(convert(folder_.path() / "again.las", folder_.path() / "local.las",
                          {.write = {.crs = "local"}}));
}

// Its time is told by the file, and --start tells it better.
TEST_F(Convert, AFormatWithoutUnitsIsNoted) {
  const fs::path feet = folder_.path() / "feet.las", metres = folder_.path() / "metres.las";
  scan::LasOptions options;
  options.crs_wkt = scan::coded_crs_wkt(0, {.horizontal_m = 1200.0 / 3937});
  scan::LasWriter writer(feet, options);
  writer.write(points_of(scan_ / "cloud.pcd"));
  writer.close();
  EXPECT_THAT(convert(feet, folder_.path() / "out.ply", {}).notes,
              ElementsAre(HasSubstr("US survey feet")));
  EXPECT_TRUE(convert(feet, folder_.path() / "out.las", {}).notes.empty());
  convert(scan_, metres, {});
  EXPECT_TRUE(convert(metres, folder_.path() / "metres.ply", {}).notes.empty());
}

TEST_F(Convert, ALasWithATrajectoryKeepsItsTime) {
  const fs::path las = folder_.path() / "cloud.las";
  lidar::fly(testing::small_farm(), folder_.path() / "may", {.start_utc = "2025-05-04T03:02:01Z"});
  convert(folder_.path() / "may", las, {});
  FlightOptions flight{.trajectory = scan_ / "poses.csv"};
  const auto start_of = [&](const char* out) {
    convert(las, folder_.path() / out, {.flight = flight});
    return format_utc(scan::read_cloud_info(folder_.path() / out).start.value());
  };
  EXPECT_EQ(start_of("kept.las"), "2025-05-04T03:02:01Z");
  flight.start_utc = "2025-05-04T03:00:00Z";
  EXPECT_EQ(start_of("told.las"), "2025-05-04T03:00:00Z");
}

}  // namespace
}  // namespace plotscan::record
