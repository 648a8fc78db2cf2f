// SPDX-License-Identifier: Apache-2.0
#include "record/convert.h"

#include <fstream>

#include "lidarsim/lidar/small_farm.h"
#include "lidarsim/scan/foreign_las.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "lidar/fly.h"
#include "record/open_source.h"
#include "scan/cloud_system.h"
#include "scan/cloud_writer.h"
#include "scan/las_crs.h"
#include "scan/las_writer.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

std::vector<scan::LabelledPoint> points_of(const fs::path& file) {
  std::vector<scan::LabelledPoint> points;
  scan::read_points(file, scan::read_cloud_info(file),
                    [&](auto piece) { points.insert(points.end(), piece.begin(), piece.end()); });
  return points;
}

void write_pcd(const fs::path& file, const std::vector<scan::LabelledPoint>& points,
               const scan::CloudWriteOptions& options = {}) {
  scan::PcdWriter writer(file, options);
  writer.write(points);
  writer.close();
}

struct Recorded {
  std::optional<UtcTime> start;
  std::vector<scan::LabelledPoint> points;
};

// Of any format.
Recorded recorded(const fs::path& file) {
  const Source source = open_source(file, {});
  Recorded read{.start = source.info.start, .points = {}};
  source.stream(
      [&](auto piece) { read.points.insert(read.points.end(), piece.begin(), piece.end()); });
  return read;
}

// Within the steps of LAS: 0.1 mm, 60 ns, and 1/257 of intensity.
void expect_same(const std::vector<scan::LabelledPoint>& read,
                 const std::vector<scan::LabelledPoint>& expected) {
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    scan::LabelledPoint point = read[i];
    ASSERT_NEAR(point.x, expected[i].x, 1.1e-4);
    ASSERT_NEAR(point.y, expected[i].y, 1.1e-4);
    ASSERT_NEAR(point.z, expected[i].z, 1.1e-4);
    ASSERT_NEAR(point.intensity, expected[i].intensity, 1e-2);
    ASSERT_NEAR(point.time, expected[i].time, 1e-7);
    point.x = expected[i].x;
    point.y = expected[i].y;
    point.z = expected[i].z;
    point.intensity = expected[i].intensity;
    point.time = expected[i].time;
    ASSERT_EQ(point, expected[i]) << "point " << i;
  }
}

// A line of /proc/self/status in kilobytes.
long status_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
  return 0;
}

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

// Every cloud format to every other and back to PCD: the same points, but for LAS' steps.
TEST_F(Convert, EveryCloudFormatHoldsEveryField) {
  struct Kind {
    const char* extension;
    const char* encoding;
  };
  const std::vector<Kind> kinds = {{".pcd", "binary"}, {".pcd", "compressed"}, {".pcd", "ascii"},
                                   {".ply", "binary"}, {".ply", "ascii"},      {".las", ""}};
  const auto original = points_of(scan_ / "cloud.pcd");
  for (const Kind& first : kinds) {
    const fs::path one = folder_.path() / (std::string("one") + first.extension);
    convert(scan_, one, {.write = {.encoding = first.encoding}, .replace = true});
    for (const Kind& second : kinds) {
      const fs::path two = folder_.path() / (std::string("two") + second.extension);
      convert(one, two, {.write = {.encoding = second.encoding}, .replace = true});
      expect_same(points_of(two), original);
    }
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
  lidar::fly(farm, folder_.path() / "anchored", {}, false);
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
  for (const double roll_deg : {std::nan(""), 361.0}) {
    wrong = flight;
    wrong.mount_rpy_deg.x() = roll_deg;
    EXPECT_THAT(refusal(scan_ / "cloud.pcd", "out.bag", {.flight = wrong}), HasSubstr("--mount"));
  }
}

// What a recording says by itself is not told.
TEST_F(Convert, ARecordingSaysMuchByItself) {
  const fs::path bag = folder_.path() / "flight.bag", pcap = folder_.path() / "flight.pcap";
  convert(scan_, bag, {});
  FlightOptions flight{.trajectory = scan_ / "poses.csv"};
  EXPECT_THAT(refusal(bag, "out.pcd", {.flight = flight}), HasSubstr("its own poses (/tf)"));
  if (find_format(pcap) == nullptr) return;
  convert(scan_, pcap, {});
  EXPECT_THAT(convert(pcap, folder_.path() / "own.pcd", {}).notes,
              ElementsAre(HasSubstr("without --trajectory")));
  flight.start_utc = "2020-01-01T00:00:00Z";
  EXPECT_THAT(refusal(pcap, "out.las", {.flight = flight}),
              HasSubstr("says by itself when it was recorded"));
}

// A map in UTM: the poses that a recording holds lie in it, too.
TEST_F(Convert, ARecordingOfAMapHasItsPlaces) {
  const Eigen::Vector3d place(544'000, 4'117'000, 600);
  const fs::path map = folder_.path() / "map.pcd";
  write_pcd(map, points_of(scan_ / "cloud.pcd"), {.origin_m = place});
  const fs::path poses = folder_.path() / "map.tum";
  scan::write_tum(poses, scan::moved(scan::read_trajectory(scan_ / "poses.csv"), place));
  const auto first_place = [](const fs::path& file) {
    const Source source = open_source(file, {});
    std::optional<Eigen::Vector3d> first;
    source.stream([&](auto piece) {
      if (!first) first = Eigen::Vector3d(piece[0].x, piece[0].y, piece[0].z);
    });
    return Eigen::Vector3d(source.info.origin_m + first.value());
  };
  for (const char* name : {"map.bag", "map.mcap"}) {
    const fs::path recording = folder_.path() / name;
    convert(map, recording, {.flight = FlightOptions{.trajectory = poses}});
    EXPECT_LT((first_place(recording) - first_place(map)).norm(), 1e-3) << name;
  }
}

TEST_F(Convert, ACloudThatIsNotInTheOrderOfTimeIsNoRecording) {
  std::vector<scan::LabelledPoint> points = points_of(scan_ / "cloud.pcd");
  std::ranges::reverse(points);
  const fs::path reversed = folder_.path() / "reversed.pcd";
  write_pcd(reversed, points);
  EXPECT_THAT(
      refusal(reversed, "out.mcap", {.flight = FlightOptions{.trajectory = scan_ / "poses.csv"}}),
      HasSubstr("needs the cloud in the order of time"));
}

// Nothing says where the sensor was after the trajectory's end.
TEST_F(Convert, APcapEndsWithItsTrajectory) {
  const fs::path pcap = folder_.path() / "flight.pcap", out = folder_.path() / "half.pcd";
  if (find_format(pcap) == nullptr) GTEST_SKIP() << "built without libpcap";
  convert(scan_, pcap, {});
  std::vector<scan::StampedPose> poses = scan::read_trajectory(scan_ / "poses.csv").poses();
  const double half_s = poses.back().time_s / 2;
  std::erase_if(poses, [&](const scan::StampedPose& pose) { return pose.time_s > half_s; });
  scan::write_tum(folder_.path() / "half.tum", scan::Trajectory(poses));
  const ConvertSummary summary =
      convert(pcap, out, {.flight = FlightOptions{.trajectory = folder_.path() / "half.tum"}});
  EXPECT_GT(summary.without_place, 0U);
  EXPECT_EQ(summary.points + summary.without_place, points_of(scan_ / "cloud.pcd").size());
  for (const scan::LabelledPoint& point : points_of(out)) EXPECT_LE(point.time, half_s + 0.11);
}

// Turns are told by the packets' azimuths: a cloud a turn.
TEST_F(Convert, APcapTellsTheSpin) {
  const fs::path pcap = folder_.path() / "flight.pcap", spun = folder_.path() / "spun";
  if (find_format(pcap) == nullptr) GTEST_SKIP() << "built without libpcap";
  for (const double spin_hz : {7.5, 20.0}) {
    lidar::FlyOptions options;
    options.spin_hz = spin_hz;
    lidar::fly(testing::small_farm(), spun, options, true);
    convert(spun, pcap, {.replace = true});
    const Source source =
        open_source(pcap, {.flight = FlightOptions{.trajectory = spun / "poses.csv"}});
    EXPECT_NEAR(source.flight->spin_hz, spin_hz, spin_hz == 20 ? 0 : 0.05);
  }
}

// A cloud whose clock does not begin with the flight, with a trajectory of the same clock: the
// scan's own LAS and bag, so much later.
TEST_F(Convert, ABareCloudAndItsTrajectoryMayCountFromAnyTime) {
  const double begin_s = 1000;
  const fs::path later = folder_.path() / "later.pcd";
  std::vector<scan::LabelledPoint> points = points_of(scan_ / "cloud.pcd");
  for (scan::LabelledPoint& point : points) point.time += begin_s;
  write_pcd(later, points);
  scan::write_tum(folder_.path() / "later.tum",
                  scan::delayed(scan::read_trajectory(scan_ / "poses.csv"), begin_s));
  const FlightOptions flight{.trajectory = folder_.path() / "later.tum",
                             .start_utc = "2026-06-01T09:43:20Z"};  // 1000 s before 10:00
  for (const std::string extension : {".las", ".bag"}) {
    const fs::path from_scan = folder_.path() / ("scan" + extension);
    const fs::path from_cloud = folder_.path() / ("cloud" + extension);
    convert(scan_, from_scan, {});
    convert(later, from_cloud, {.flight = flight});
    EXPECT_EQ(recorded(from_cloud).start, recorded(from_scan).start);
    expect_same(recorded(from_cloud).points, recorded(from_scan).points);
  }
}

TEST_F(Convert, ACloudInAnotherTimeThanItsTrajectoryIsNoRecording) {
  const scan::Trajectory flown = scan::read_trajectory(scan_ / "poses.csv");
  scan::write_tum(folder_.path() / "early.tum", scan::delayed(flown, -5000));
  const ConvertOptions options{.flight = FlightOptions{.trajectory = folder_.path() / "early.tum"}};
  for (const char* out : {"out.bag", "out.las"})
    EXPECT_THAT(refusal(scan_ / "cloud.pcd", out, options), HasSubstr("in the same time")) << out;
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
  lidar::fly(testing::small_farm(), folder_.path() / "may", {.start_utc = "2025-05-04T03:02:01Z"},
             false);
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
