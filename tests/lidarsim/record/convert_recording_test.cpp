// SPDX-License-Identifier: Apache-2.0
// Conversions with a trajectory: of bare clouds to recordings, and of recordings.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/manifest.h"
#include "lidarsim/record/convert_fixture.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
    options.replace = true;
    lidar::fly(testing::small_farm(), spun, options);
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

}  // namespace
}  // namespace plotscan::record
