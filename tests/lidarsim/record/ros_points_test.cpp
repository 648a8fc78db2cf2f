// SPDX-License-Identifier: Apache-2.0
#include "record/ros/ros_points.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "lidarsim/record/ros_flight.h"
#include "lidarsim/record/ros_readers.h"
#include "record/convert.h"
#include "record/ros/internal/cloud_message.h"
#include "scan/point_reader.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using testing::Circle;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

std::vector<scan::LabelledPoint> read_all(const std::filesystem::path& file) {
  std::vector<scan::LabelledPoint> points;
  RosPoints(file).stream([&](std::span<const scan::LabelledPoint> piece) {
    points.insert(points.end(), piece.begin(), piece.end());
  });
  return points;
}

std::string bytes_of(const std::filesystem::path& file) { return read_text(file); }

// The frames that have none above them.
std::set<std::string> topmost_frames(const std::filesystem::path& file) {
  std::set<std::string> parents;
  std::set<std::string> children;
  ros::read_messages(file, [&](const ros::Message& message) {
    if (message.topic.type != ros::TFMessage::kType) return;
    const auto read = ros::decode<ros::TFMessage>(message.version, message.bytes);
    for (const ros::TransformStamped& transform : read.transforms) {
      parents.insert(transform.header.frame_id);
      children.insert(transform.child_frame_id);
    }
  });
  for (const std::string& child : children) parents.erase(child);
  return parents;
}

void expect_same(const std::vector<scan::LabelledPoint>& read,
                 const std::vector<scan::LabelledPoint>& truth) {
  ASSERT_EQ(read.size(), truth.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    ASSERT_LT((testing::position(read[i]) - testing::position(truth[i])).norm(), 4e-6);
    ASSERT_NEAR(read[i].time, truth[i].time, 5e-9);
    ASSERT_EQ(read[i].intensity, truth[i].intensity);
    ASSERT_EQ(read[i].ring, truth[i].ring);
    ASSERT_EQ(read[i].return_number, truth[i].return_number);
    ASSERT_EQ(read[i].return_count, truth[i].return_count);
    ASSERT_EQ(read[i].label, truth[i].label);
    ASSERT_EQ(read[i].plot, truth[i].plot);
    ASSERT_EQ(read[i].plant, truth[i].plant);
  }
}

class RosFiles : public ::testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path file(const std::string& name) const {
    return folder_.path() / (name + GetParam());
  }
  const TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Files, RosFiles, ::testing::Values(".bag", ".mcap"),
                         [](const auto& kind) { return kind.param.substr(1); });

TEST_P(RosFiles, PointsComeBack) {
  const FlightRecord flight = testing::circle_flight();
  const auto points = testing::scanned(flight);
  testing::record_to(file("flight"), flight, points);
  const RosPoints recorded(file("flight"));
  EXPECT_EQ(recorded.topic(), "/velodyne_points");
  EXPECT_EQ(topmost_frames(file("flight")), std::set<std::string>{"map"});
  EXPECT_EQ(recorded.points(), points.size());
  EXPECT_EQ(format_utc(recorded.start()), "2026-06-01T10:00:00.250001Z");
  expect_same(read_all(file("flight")), points);
}

// The sensor is mounted still on the body, whose motion is read.
TEST_P(RosFiles, TheTrajectoryComesBack) {
  const FlightRecord flight = testing::circle_flight();
  testing::record_to(file("flight"), flight, testing::scanned(flight));
  const fs::path tum = folder_.path() / "flight.tum";
  EXPECT_EQ(convert(file("flight"), tum, {}).poses, flight.reported.poses().size());
  const scan::Trajectory read = scan::read_trajectory(tum);
  ASSERT_EQ(read.poses().size(), flight.reported.poses().size());
  for (std::size_t i = 0; i < read.poses().size(); ++i) {
    const scan::StampedPose& expected = flight.reported.poses()[i];
    EXPECT_NEAR(read.poses()[i].time_s, expected.time_s, 2e-9);
    EXPECT_LT((read.poses()[i].position_m - expected.position_m).norm(), 1e-12);
    EXPECT_LT(read.poses()[i].attitude.angularDistance(expected.attitude), 1e-7);
  }
}

// A gimbal that turns on a drone that flies: the gimbal's motion in the world, while both are
// known.
TEST_P(RosFiles, AChainOfMovingFramesIsOneTrajectory) {
  auto writer =
      testing::create_file(file("gimbal"), {{.name = "/tf", .type = ros::TFMessage::kType},
                                            {.name = "/points", .type = ros::PointCloud2::kType}});
  const auto transform = [](std::int64_t ns, const char* parent, const char* child, double x) {
    ros::TransformStamped stamped;
    stamped.header = {.stamp = {ns}, .frame_id = parent};
    stamped.child_frame_id = child;
    stamped.transform.translation = {x, 0, 0};
    stamped.transform.rotation = {0, 0, 0, 1};
    return stamped;
  };
  const std::int64_t second = 1'000'000'000;
  const ros::TFMessage moves{
      {transform(second, "map", "body", 0), transform(3 * second, "map", "body", 20),
       transform(second, "body", "gimbal", 1), transform(2 * second, "body", "gimbal", 2),
       transform(4 * second, "body", "gimbal", 3)}};
  writer->write(0, {second}, ros::encode(writer->version(), moves));
  auto cloud = labelled_cloud({.stamp = {second}, .frame_id = "gimbal"});
  add_point(cloud, {.intensity = 7}, {1, 2, 3}, 0.25f);
  writer->write(1, {second}, ros::encode(writer->version(), cloud));
  writer->close();
  const auto read = RosPoints(file("gimbal")).trajectory();
  ASSERT_TRUE(read);
  ASSERT_EQ(read->poses().size(), 2u);  // the body is not known 4 s on
  EXPECT_EQ(read->poses()[0].position_m, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(read->poses()[1].position_m, Eigen::Vector3d(12, 0, 0));
  EXPECT_EQ(read->poses()[1].time_s, 1);
}

// A trajectory of poses further apart than transforms may be, and one that starts late.
TEST_P(RosFiles, PosesFarApartMoveTheSame) {
  FlightRecord flight = testing::circle_flight();
  flight.reported = Circle().flown(0.27, 3);
  const auto points = testing::scanned(flight);
  testing::record_to(file("flight"), flight, points);
  expect_same(read_all(file("flight")), points);
}

TEST_P(RosFiles, TheSameInputGivesTheSameBytes) {
  const FlightRecord flight = testing::circle_flight();
  const auto points = testing::scanned(flight);
  testing::record_to(file("once"), flight, points);
  testing::record_to(file("again"), flight, points);
  EXPECT_TRUE(bytes_of(file("once")) == bytes_of(file("again")));
}

TEST_P(RosFiles, ATruncatedFileIsRefused) {
  const FlightRecord flight = testing::circle_flight();
  testing::record_to(file("whole"), flight, testing::scanned(flight));
  const std::string whole = bytes_of(file("whole"));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{5}, std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(file("part"), std::ios::binary) << whole.substr(0, size);
    EXPECT_THAT(message_of<InputError>([&] { read_all(file("part")); }), HasSubstr("part")) << size;
  }
}

// Broken bytes give an InputError or other points; never a crash, endless work or lots of memory.
TEST_P(RosFiles, BrokenBytesDoNoHarm) {
  FlightRecord flight = testing::circle_flight();
  flight.reported = Circle().flown(0.01, 3);
  testing::record_to(file("whole"), flight, testing::scanned(flight));
  const std::string whole = bytes_of(file("whole"));
  int refused = 0;
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    RandomStream stream(attempt, random_purpose("test/broken"), 0);
    std::string broken = whole;
    // Records lie dense at both ends.
    const std::size_t span = std::min<std::size_t>(whole.size(), 6000);
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = stream.below(span);
      broken[attempt % 2 == 0 ? at : whole.size() - 1 - at] = static_cast<char>(stream.below(256));
    }
    std::ofstream(file("broken"), std::ios::binary) << broken;
    try {
      read_all(file("broken"));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);  // many bytes are text that nobody reads
}

TEST_P(RosFiles, FilesWithoutCloudsAreRefused) {
  auto writer = testing::create_file(file("none"), {{.name = "/clock", .type = ros::Clock::kType}});
  writer->write(0, {1}, ros::encode(writer->version(), ros::Clock{{1}}));
  writer->close();
  EXPECT_THAT(message_of<InputError>([&] { RosPoints{file("none")}; }),
              HasSubstr("holds no clouds"));
}

// A cloud of one point, with a field of times beside x, y and z.
template <class Number>
ros::PointCloud2 timed_cloud(const std::string& name, std::uint8_t datatype, Number time) {
  ros::PointCloud2 cloud{.header = {.stamp = {1'780'000'000'500'000'000}, .frame_id = "lidar"}};
  std::vector<std::uint8_t> bytes(12);
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    cloud.point_fields.push_back({.name = std::string(1, static_cast<char>('x' + axis)),
                                  .offset = 4 * axis,
                                  .datatype = ros::PointField::kFloat32,
                                  .count = 1});
  cloud.point_fields.push_back({.name = name, .offset = 12, .datatype = datatype, .count = 1});
  bytes.resize(12 + sizeof time);
  std::memcpy(bytes.data() + 12, &time, sizeof time);
  cloud.width = cloud.height = 1;
  cloud.point_step = cloud.row_step = static_cast<std::uint32_t>(bytes.size());
  cloud.data = std::move(bytes);
  return cloud;
}

// The fields of velodyne_pointcloud, Ouster, Hesai and Robosense, Livox, and other ways of counting
// a quarter of a second after the cloud's stamp.
TEST(CloudPoints, TimesAreReadAsDriversWriteThem) {
  using ros::PointField;
  const auto time_of = [](const ros::PointCloud2& cloud) {
    const CloudPoints points(cloud);
    EXPECT_THAT(points.fields(), ::testing::Contains("time"));
    return points.point(0).time;
  };
  EXPECT_NEAR(time_of(timed_cloud("time", PointField::kFloat32, 0.25F)), 0.25, 1e-9);
  EXPECT_NEAR(time_of(timed_cloud("t", PointField::kUint32, 250'000'000U)), 0.25, 1e-9);
  EXPECT_NEAR(time_of(timed_cloud("time", PointField::kUint32, 250'000'000U)), 0.25, 1e-9);
  EXPECT_NEAR(time_of(timed_cloud("Time", PointField::kFloat64, -0.25)), -0.25, 1e-9);
  EXPECT_NEAR(time_of(timed_cloud("timestamp", PointField::kFloat64, 1'780'000'000.75)), 0.25,
              1e-6);
  EXPECT_NEAR(time_of(timed_cloud("timestamp", PointField::kFloat64, 1.78000000075e15)), 0.25,
              1e-6);
  EXPECT_NEAR(time_of(timed_cloud("timestamp", PointField::kFloat64, 1.78000000075e18)), 0.25,
              1e-6);
}

TEST(CloudPoints, TimesOfAnotherClockAreNone) {
  const ros::PointCloud2 cloud = timed_cloud("time", ros::PointField::kFloat64, 86'400.0);
  const CloudPoints points(cloud);
  EXPECT_THAT(points.fields(), ::testing::ElementsAre("x", "y", "z"));
  EXPECT_EQ(points.point(0).time, 0);
}

// The sensor moves, and nothing says when each point was measured.
TEST_P(RosFiles, CloudsWithoutTimesAreNoted) {
  const auto written = [&](const ros::PointCloud2& cloud) {
    auto writer =
        testing::create_file(file("timed"), {{.name = "/tf", .type = ros::TFMessage::kType},
                                             {.name = "/points", .type = ros::PointCloud2::kType}});
    const std::int64_t stamp_ns = cloud.header.stamp.ns;
    ros::TFMessage moves;
    for (const int second : {-1, 1}) {
      ros::TransformStamped pose;
      pose.header = {.stamp = {stamp_ns + second * 1'000'000'000LL}, .frame_id = "map"};
      pose.child_frame_id = "lidar";
      pose.transform.translation = {1.0 * second, 0, 0};
      pose.transform.rotation = {0, 0, 0, 1};
      moves.transforms.push_back(pose);
    }
    writer->write(0, {stamp_ns - 1'000'000'000}, ros::encode(writer->version(), moves));
    writer->write(1, {stamp_ns}, ros::encode(writer->version(), cloud));
    writer->close();
    return RosPoints(file("timed")).notes();
  };
  EXPECT_TRUE(written(timed_cloud("time", ros::PointField::kFloat32, 0.25F)).empty());
  EXPECT_THAT(written(timed_cloud("when", ros::PointField::kFloat32, 0.25F)),
              ::testing::ElementsAre(HasSubstr("have no times of their points")));
}

// A camera's or a detector's cloud beside the sensor's.
TEST_P(RosFiles, CloudsWithoutPositionsAreNoConcernOfOthers) {
  const std::vector<ros::Topic> topics = {{.name = "/empty", .type = ros::PointCloud2::kType},
                                          {.name = "/lidar", .type = ros::PointCloud2::kType}};
  auto writer = testing::create_file(file("mixed"), topics);
  const ros::PointCloud2 empty{.header = {.stamp = {2'000'000'000}, .frame_id = "camera"}};
  writer->write(0, {2'000'000'000}, ros::encode(writer->version(), empty));
  auto cloud = labelled_cloud({.stamp = {2'000'000'000}, .frame_id = "sensor"});
  add_point(cloud, {}, {1, 2, 3}, 0);
  writer->write(1, {2'000'000'000}, ros::encode(writer->version(), cloud));
  writer->close();
  EXPECT_EQ(RosPoints(file("mixed"), "/lidar").points(), 1u);
  EXPECT_EQ(RosPoints(file("mixed")).points(), 1u);  // the only one that can be read
  EXPECT_THROW(RosPoints(file("mixed"), "/empty"), InputError);
}

TEST_P(RosFiles, ATopicIsChosenWhereThereAreSeveral) {
  const std::vector<ros::Topic> topics = {{.name = "/front", .type = ros::PointCloud2::kType},
                                          {.name = "/rear", .type = ros::PointCloud2::kType}};
  auto writer = testing::create_file(file("two"), topics);
  for (std::size_t topic : {0, 1}) {
    auto cloud = labelled_cloud({.stamp = {2'000'000'000}, .frame_id = "sensor"});
    add_point(cloud, {.intensity = 7}, {1, 2, static_cast<float>(topic)}, 0.25f);
    writer->write(topic, {2'000'000'000}, ros::encode(writer->version(), cloud));
  }
  writer->close();
  EXPECT_THAT(message_of<InputError>([&] { RosPoints{file("two")}; }), HasSubstr("/front, /rear"));
  EXPECT_THAT(message_of<InputError>([&] { RosPoints(file("two"), "/top"); }), HasSubstr("/top"));
  std::vector<scan::LabelledPoint> points;
  const RosPoints rear(file("two"), "/rear");
  // Without transforms the points stay where they are.
  rear.stream([&](auto piece) { points.assign(piece.begin(), piece.end()); });
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].z, 1);
  EXPECT_EQ(points[0].time, 0.25);
  EXPECT_FALSE(rear.trajectory());

  const auto refusal = [&](const fs::path& in, const char* out, const ConvertOptions& options) {
    return message_of<InputError>([&] { convert(in, folder_.path() / out, options); });
  };
  convert(file("two"), folder_.path() / "rear.pcd", {.topic = "/rear"});
  const fs::path pcd = folder_.path() / "rear.pcd";
  scan::read_points(pcd, scan::read_cloud_info(pcd), [&](auto piece) { EXPECT_EQ(piece[0].z, 1); });
  EXPECT_THAT(refusal(file("two"), "a.pcd", {}), HasSubstr("--topic: /front, /rear"));
  EXPECT_THAT(refusal(file("two"), "a.tum", {.topic = "/rear"}), HasSubstr("no trajectory"));
  EXPECT_THAT(refusal(pcd, "a.las", {.topic = "/rear"}), HasSubstr("has no topics"));
}

// A bag that rosbag compressed.
TEST(RosBag, CompressedByRosbag) {
  if (const std::string why = testing::why_no_reader(".bag"); !why.empty()) GTEST_SKIP() << why;
  const TemporaryFolder folder;
  const FlightRecord flight = testing::circle_flight();
  const auto points = testing::scanned(flight);
  testing::record_to(folder.path() / "plain.bag", flight, points);
  const auto compress = [&](const std::string& method) {
    return testing::succeeds("cd '" + folder.path().string() +
                             "' && /usr/bin/python3 -c \"import rosbag\n"
                             "out = rosbag.Bag('" +
                             method + ".bag', 'w', compression='" + method +
                             "')\n"
                             "for m in rosbag.Bag('plain.bag').read_messages(raw=True):\n"
                             "    out.write(m.topic, m.message, m.timestamp, raw=True)\n"
                             "out.close()\"");
  };
  ASSERT_TRUE(compress("lz4"));
  EXPECT_LT(std::filesystem::file_size(folder.path() / "lz4.bag"),
            std::filesystem::file_size(folder.path() / "plain.bag"));
  expect_same(read_all(folder.path() / "lz4.bag"), points);
  ASSERT_TRUE(compress("bz2"));
  EXPECT_THAT(message_of<InputError>([&] { read_all(folder.path() / "bz2.bag"); }),
              HasSubstr("compressed by bz2"));
}

// As all parts of a bag are written: their length in 4 bytes, the lowest first, before them.
std::string with_length(const std::string& bytes) {
  std::string length(4, '\0');
  for (std::size_t i = 0; i < 4; ++i) length[i] = static_cast<char>(bytes.size() >> (8 * i));
  return length + bytes;
}

// A bag of nothing but its header.
TEST(RosBag, EncryptedOrNotClosedSaysWhatMendsIt) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& encryptor, char index_at) {
    const std::string fields =
        with_length("op=\x03") +
        with_length("index_pos=" + std::string(1, index_at) + std::string(7, '\0')) +
        with_length("encryptor=" + encryptor);
    const fs::path bag =
        folder.write("a.bag", "#ROSBAG V2.0\n" + with_length(fields) + with_length("   "));
    return message_of<InputError>([&] { read_all(bag); });
  };
  EXPECT_THAT(message("rosbag/AesCbcEncryptor", 1), HasSubstr("is encrypted; `rosbag decrypt`"));
  EXPECT_THAT(message("", 0), HasSubstr("was not closed; `rosbag reindex`"));
  EXPECT_THAT(message("", 1), HasSubstr("holds no clouds"));
}

}  // namespace
}  // namespace plotscan::record
