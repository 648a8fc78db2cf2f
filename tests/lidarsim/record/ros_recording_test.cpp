// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "lidarsim/record/ros_flight.h"
#include "lidarsim/record/ros_readers.h"
#include "record/ros/ros_points.h"
#include "temporary_folder.h"

// What RosRecorder writes, as readers of others see it.
namespace plotscan::record {
namespace {

using nlohmann::json;
using testing::Circle;
using testing::ReadFile;

constexpr std::int64_t kStart_us = 1780308000250001;  // 2026-06-01T10:00:00.250001Z

// Seconds from the flight's start of [seconds, nanoseconds].
double since_start_s(const json& stamp) {
  const std::int64_t ns = (stamp[0].get<std::int64_t>() - kStart_us / 1'000'000) * 1'000'000'000 +
                          stamp[1].get<std::int64_t>() - kStart_us % 1'000'000 * 1000;
  return 1e-9 * static_cast<double>(ns);
}

double number(const json& value) { return value.get<double>(); }

Eigen::Vector3d vector_of(const json& v) {
  return Eigen::Vector3d(number(v[0]), number(v[1]), number(v[2]));
}
Eigen::Quaterniond quaternion_of(const json& q) {
  return Eigen::Quaterniond(number(q[3]), number(q[0]), number(q[1]), number(q[2]));
}

class RosRecording : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string why = testing::why_no_reader(GetParam());
    if (!why.empty()) GTEST_SKIP() << why;
  }
  // The same flight serves most tests; it is recorded and read once.
  const ReadFile& read() {
    static std::map<std::string, ReadFile> all;
    if (!all.contains(GetParam())) {
      testing::record_to(file(), flight_, points(), {.packets = true});
      all[GetParam()] = testing::read_by_others(file());
    }
    return all[GetParam()];
  }
  const std::vector<scan::LabelledPoint>& points() {
    static const std::vector<scan::LabelledPoint> all = testing::scanned(flight_);
    return all;
  }
  std::filesystem::path file() const { return folder_.path() / ("flight" + GetParam()); }

  const testing::TemporaryFolder folder_;
  const FlightRecord flight_ = testing::circle_flight();
};

INSTANTIATE_TEST_SUITE_P(Files, RosRecording, ::testing::Values(".bag", ".mcap"),
                         [](const auto& kind) { return kind.param.substr(1); });

TEST_P(RosRecording, HasTheTopicsAndTypesOfARobot) {
  const json& topics = read().document["topics"];
  const bool is_bag = GetParam() == ".bag";
  const std::map<std::string, std::string> expected = {
      {"/clock", "rosgraph_msgs/Clock"},
      {"/tf", "tf2_msgs/TFMessage"},
      {"/tf_static", "tf2_msgs/TFMessage"},
      {"/imu", "sensor_msgs/Imu"},
      {"/gps/fix", "sensor_msgs/NavSatFix"},
      {"/velodyne_points", "sensor_msgs/PointCloud2"},
      {"/velodyne_packets", "velodyne_msgs/VelodyneScan"}};
  EXPECT_EQ(topics.size(), expected.size());
  for (const auto& [name, type] : expected) {
    std::string in_file = type;
    if (!is_bag) in_file.insert(in_file.find('/'), "/msg");
    ASSERT_TRUE(topics.contains(name)) << name;
    EXPECT_EQ(topics[name]["type"], in_file);
    EXPECT_EQ(topics[name]["latched"], name == "/tf_static");
    // The definition in the bag and ROS's own class have the checksum that the bag states.
    if (is_bag) {
      EXPECT_EQ(topics[name]["sums"], 1) << name;
    }
    if (is_bag) {
      EXPECT_EQ(topics[name]["known"], name != "/velodyne_packets") << name;
    }
    if (!is_bag) {
      EXPECT_EQ(topics[name]["schema_encoding"], "ros2msg");
    }
    if (!is_bag) {
      EXPECT_EQ(topics[name]["encoding"], "cdr");
    }
    if (!is_bag) {
      EXPECT_EQ(topics[name]["count"], read().messages(name).size());
    }
  }
  if (!is_bag) {
    EXPECT_EQ(read().document["profile"], "ros2");
  }
}

TEST_P(RosRecording, MessagesComeInTheOrderOfTimeAtTheirRates) {
  const std::map<std::string, std::size_t> expected = {
      {"/clock", 56}, {"/tf", 56}, {"/imu", 56}, {"/gps/fix", 6}, {"/tf_static", 1}};
  for (const auto& [topic, count] : expected) {
    const auto messages = read().messages(topic);
    ASSERT_EQ(messages.size(), count) << topic;
    const double interval_s = topic == "/gps/fix" ? 0.1 : 0.01;
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(since_start_s(messages[i]["log"]), interval_s * static_cast<double>(i), 2e-9);
  }
  double before_s = 0;
  for (const json& message : read().document["messages"]) {
    EXPECT_GE(since_start_s(message["log"]), before_s);
    before_s = since_start_s(message["log"]);
    // What a message says of the present is said at that time; sweeps come when they end.
    const bool is_sweep = message["topic"].get<std::string>().starts_with("/velodyne");
    if (message.contains("stamp") && !is_sweep) {
      EXPECT_EQ(message["stamp"], message["log"]);
    }
    if (message.contains("clock")) {
      EXPECT_EQ(message["clock"], message["log"]);
    }
  }
}

TEST_P(RosRecording, CloudsAreTheTurnsOfTheSensorAsItsDriverHasThem) {
  const auto clouds = read().messages("/velodyne_points");
  ASSERT_EQ(clouds.size(), 6u);
  const json fields = {{"x", 0, 7, 1},
                       {"y", 4, 7, 1},
                       {"z", 8, 7, 1},
                       {"intensity", 12, 7, 1},
                       {"ring", 16, 4, 1},
                       {"time", 18, 7, 1},
                       {"return_number", 22, 2, 1},
                       {"return_count", 23, 2, 1},
                       {"class", 24, 2, 1},
                       {"plot", 25, 6, 1},
                       {"plant", 29, 6, 1}};
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const double begin_s = 0.1 * static_cast<double>(i);
    EXPECT_EQ(clouds[i]["frame"], "velodyne");
    EXPECT_NEAR(since_start_s(clouds[i]["stamp"]), begin_s, 2e-9);
    EXPECT_NEAR(since_start_s(clouds[i]["log"]), std::min(begin_s + 0.1, 0.55), 2e-9);
    EXPECT_EQ(clouds[i]["fields"], fields);
    EXPECT_EQ(clouds[i]["point_step"], 33);
    EXPECT_EQ(clouds[i]["height"], 1);
    EXPECT_EQ(clouds[i]["is_dense"], true);
    EXPECT_EQ(clouds[i]["bytes"], 33 * clouds[i]["width"].get<int>());
    EXPECT_EQ(clouds[i]["row_step"], clouds[i]["bytes"]);
  }
}

// The pose at a time from /tf and /tf_static alone: linear and slerp between the messages.
Eigen::Isometry3d world_from_velodyne(const std::vector<json>& poses, const json& mount,
                                      double time_s) {
  const auto i = std::min(static_cast<std::size_t>(time_s / 0.01), poses.size() - 2);
  const auto& a = poses[i]["transforms"][0];
  const auto& b = poses[i + 1]["transforms"][0];
  const double begin_s = since_start_s(a["stamp"]);
  const double share = (time_s - begin_s) / (since_start_s(b["stamp"]) - begin_s);
  Eigen::Isometry3d body(quaternion_of(a["rotation"]).slerp(share, quaternion_of(b["rotation"])));
  body.pretranslate(vector_of(a["translation"]) +
                    share * (vector_of(b["translation"]) - vector_of(a["translation"])));
  Eigen::Isometry3d lidar(quaternion_of(mount["rotation"]));
  lidar.pretranslate(vector_of(mount["translation"]));
  return body * lidar;
}

TEST_P(RosRecording, EveryPointComesBackToTheWorldByTheTransforms) {
  const auto poses = read().messages("/tf");
  EXPECT_EQ(poses[0]["transforms"][0]["frame"], "map");
  EXPECT_EQ(poses[0]["transforms"][0]["child"], "base_link");
  const json mounts = read().messages("/tf_static")[0]["transforms"];
  EXPECT_EQ(mounts.size(), 3u);
  for (const json& mount : mounts) EXPECT_EQ(mount["frame"], "base_link");
  EXPECT_EQ(mounts[0]["child"], "velodyne");
  EXPECT_EQ(mounts[1]["child"], "imu");
  EXPECT_EQ(mounts[2]["child"], "gps");
  ASSERT_EQ(read().points.size(), points().size());
  ASSERT_GT(points().size(), 10'000u);
  double worst_m = 0;
  double worst_s = 0;
  for (std::size_t i = 0; i < points().size(); ++i) {
    const scan::LabelledPoint& truth = points()[i];
    const testing::ReadPoint& read_point = read().points[i];
    EXPECT_GE(read_point.time, 0);
    EXPECT_LE(read_point.time, 0.1f);
    const double time_s = 0.1 * read_point.cloud + read_point.time;
    const Eigen::Vector3d world = world_from_velodyne(poses, mounts[0], time_s) *
                                  Eigen::Vector3d(read_point.x, read_point.y, read_point.z);
    worst_m = std::max(worst_m, (world - testing::position(truth)).norm());
    worst_s = std::max(worst_s, std::abs(time_s - truth.time));
    ASSERT_EQ(read_point.intensity, truth.intensity);
    ASSERT_EQ(read_point.ring, truth.ring);
    ASSERT_EQ(read_point.return_number, truth.return_number);
    ASSERT_EQ(read_point.return_count, truth.return_count);
    ASSERT_EQ(read_point.label, static_cast<double>(truth.label));
    ASSERT_EQ(read_point.plot, truth.plot);
    ASSERT_EQ(read_point.plant, truth.plant);
  }
  // Floats of positions in two frames within 20 m, and of times within 0.1 s.
  EXPECT_LT(worst_m, 4e-6);
  EXPECT_LT(worst_s, 5e-9);
}

TEST_P(RosRecording, TheInertialUnitFeelsTheCircle) {
  const auto samples = read().messages("/imu");
  const Circle circle;
  // Chords of equal length: the mean acceleration over an interval is the circle's, a sinc squared
  // smaller (the second difference of a circle).
  const double half = circle.rate_rad_s * 0.01 / 2;
  const double inwards =
      circle.rate_rad_s * circle.rate_rad_s * circle.radius_m * std::pow(std::sin(half) / half, 2);
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    EXPECT_EQ(samples[i]["frame"], "imu");
    EXPECT_LT((vector_of(samples[i]["angular_velocity"]) - Eigen::Vector3d(0, 0, circle.rate_rad_s))
                  .norm(),
              1e-9);
    EXPECT_LT((vector_of(samples[i]["linear_acceleration"]) - Eigen::Vector3d(0, inwards, 9.80665))
                  .norm(),
              1e-8);
    EXPECT_NEAR(quaternion_of(samples[i]["orientation"])
                    .angularDistance(flight_.reported.poses()[i].attitude),
                0, 1e-12);
  }
}

// Bowring's ellipsoid in its textbook form, Earth-centred.
Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double altitude_m) {
  constexpr double kA = 6378137.0;
  constexpr double kF = 1 / 298.257223563;
  constexpr double kE2 = kF * (2 - kF);
  const double latitude = radians(latitude_deg);
  const double longitude = radians(longitude_deg);
  const double n = kA / std::sqrt(1 - kE2 * std::pow(std::sin(latitude), 2));
  return {(n + altitude_m) * std::cos(latitude) * std::cos(longitude),
          (n + altitude_m) * std::cos(latitude) * std::sin(longitude),
          (n * (1 - kE2) + altitude_m) * std::sin(latitude)};
}

TEST_P(RosRecording, FixesLieWhereTheDroneReportsToBe) {
  const auto fixes = read().messages("/gps/fix");
  const double latitude = radians(37.2);
  const double longitude = radians(-80.5);
  Eigen::Matrix3d enu;  // rows: east, north, up at the anchor
  enu << -std::sin(longitude), std::cos(longitude), 0, -std::sin(latitude) * std::cos(longitude),
      -std::sin(latitude) * std::sin(longitude), std::cos(latitude),
      std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
      std::sin(latitude);
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    EXPECT_EQ(fixes[i]["frame"], "gps");
    EXPECT_EQ(fixes[i]["status"], 0);
    EXPECT_EQ(fixes[i]["service"], 1);
    const auto fix = vector_of(fixes[i]["fix"]);
    const Eigen::Vector3d world =
        enu * (earth_centred(fix.x(), fix.y(), fix.z()) - earth_centred(37.2, -80.5, 610));
    EXPECT_LT((world - Circle().position_m(0.1 * static_cast<double>(i))).norm(), 1e-6);
  }
}

TEST_P(RosRecording, PlacesByReportedPosesWhileTheInertialUnitFeelsTheTrueOnes) {
  FlightRecord flight = testing::circle_flight();
  std::vector<scan::StampedPose> poses = flight.reported.poses();
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].position_m += Eigen::Vector3d(1, 2, i % 2 == 0 ? 0.02 : -0.02);
  const scan::Trajectory motion = flight.reported;
  flight.reported = scan::Trajectory(poses);
  const auto points = testing::scanned(flight);
  testing::record_to(file(), flight, points, {.motion = motion});
  const ReadFile read = testing::read_by_others(file());
  const auto transforms = read.messages("/tf");
  const auto samples = read.messages("/imu");
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    EXPECT_LT(
        (vector_of(transforms[i]["transforms"][0]["translation"]) - poses[i].position_m).norm(),
        1e-12);
    EXPECT_NEAR(samples[i]["linear_acceleration"][2], 9.80665, 1e-8);
  }
  double worst_m = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = read.points[i];
    const Eigen::Vector3d world =
        world_from_velodyne(transforms, read.messages("/tf_static")[0]["transforms"][0],
                            0.1 * p.cloud + p.time) *
        Eigen::Vector3d(p.x, p.y, p.z);
    worst_m = std::max(worst_m, (world - testing::position(points[i])).norm());
    if (i > 2000) break;
  }
  EXPECT_LT(worst_m, 4e-6);
}

TEST_P(RosRecording, PacketsAreThoseThatTheSensorSent) {
  std::vector<SentPacket> sent;
  VelodyneEncoder encoder(flight_, [&](const SentPacket& packet) { sent.push_back(packet); });
  encoder.write(points());
  encoder.close();
  const auto scans = read().messages("/velodyne_packets");
  ASSERT_EQ(scans.size(), 6u);
  std::size_t n = 0;
  for (const json& scan : scans) {
    EXPECT_EQ(scan["frame"], "velodyne");
    EXPECT_EQ(scan["stamp"], scan["packets"][0]["stamp"]);
    for (const json& packet : scan["packets"]) {
      ASSERT_LT(n, sent.size());
      EXPECT_NEAR(since_start_s(packet["stamp"]), sent[n].fired_s, 2e-9);
      const auto bytes = packet["data"].get<std::vector<std::uint8_t>>();
      EXPECT_TRUE(std::ranges::equal(bytes, encode(sent[n].data))) << n;
      ++n;
    }
  }
  EXPECT_EQ(n, sent.size());
}

TEST_P(RosRecording, WithoutAnAnchorThereAreNoFixes) {
  FlightRecord flight = testing::circle_flight();
  flight.anchor.reset();
  testing::record_to(file(), flight, {});
  const ReadFile read = testing::read_by_others(file());
  EXPECT_FALSE(read.document["topics"].contains("/gps/fix"));
  const auto clouds = read.messages("/velodyne_points");
  ASSERT_EQ(clouds.size(), 6u);  // turns without a return are told of, too
  for (const json& cloud : clouds) EXPECT_EQ(cloud["width"], 0);
}

}  // namespace
}  // namespace plotscan::record
