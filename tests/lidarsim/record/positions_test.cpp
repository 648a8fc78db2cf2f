// SPDX-License-Identifier: Apache-2.0
#include "record/positions.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "lidarsim/record/ros_flight.h"
#include "record/convert.h"
#include "record/ros/internal/cloud_message.h"
#include "record/scan_folder.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::message_of;
using ::testing::Not;
using testing::TemporaryFolder;

const Eigen::Vector3d kUtm(512'345.25, 4'123'456.5, 600);

std::vector<Eigen::Vector3d> positions_of(const CloudFiles& cloud) {
  std::vector<Eigen::Vector3d> all;
  const scan::CloudSummary summary =
      read_positions(cloud, [&](auto piece) { all.insert(all.end(), piece.begin(), piece.end()); });
  EXPECT_EQ(summary.points, all.size());
  return all;
}

std::string refusal(const CloudFiles& cloud) {
  return message_of<InputError>([&] { positions_of(cloud); });
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Two points of a sensor 1 m above a body that flies 20 m east, 2 s long, from `start_m` on. They
// were met 2 m ahead of the sensor: 1 s and 1.25 s after the body's start.
fs::path write_ros(const fs::path& file, const Eigen::Vector3d& start_m,
                   float third_point_s = 1.5f) {  // after the last transform
  auto writer = testing::create_file(file, {{.name = "/tf", .type = ros::TFMessage::kType},
                                            {.name = "/points", .type = ros::PointCloud2::kType}});
  const auto transform = [](std::int64_t ns, const char* parent, const char* child,
                            const Eigen::Vector3d& at) {
    ros::TransformStamped stamped;
    stamped.header = {.stamp = {ns}, .frame_id = parent};
    stamped.child_frame_id = child;
    stamped.transform.translation = {at.x(), at.y(), at.z()};
    stamped.transform.rotation = {0, 0, 0, 1};
    return stamped;
  };
  const ros::TFMessage moves{
      {transform(kSecond_ns, "map", "body", start_m),
       transform(3 * kSecond_ns, "map", "body", start_m + Eigen::Vector3d(20, 0, 0)),
       transform(kSecond_ns, "body", "lidar", {0, 0, 1})}};
  writer->write(0, {kSecond_ns}, ros::encode(writer->version(), moves));
  auto cloud = labelled_cloud({.stamp = {2 * kSecond_ns}, .frame_id = "lidar"});
  add_point(cloud, {.label = scan::PointClass::crop, .plot = 3}, {2, 0, 0}, 0);
  add_point(cloud, {}, {2, 0, 0}, 0.25f);
  add_point(cloud, {.intensity = std::nanf("")}, {2, 0, 0}, third_point_s);
  writer->write(1, {2 * kSecond_ns}, ros::encode(writer->version(), cloud));
  writer->close();
  return file;
}

TEST(RecordedPositions, LieWhereTheTransformsPutThem) {
  const TemporaryFolder folder;
  for (const char* name : {"flight.bag", "flight.mcap"}) {
    for (const Eigen::Vector3d& start_m : {Eigen::Vector3d(1, 2, 3), kUtm}) {
      CloudFiles cloud(write_ros(folder.path() / name, start_m));
      const auto positions = positions_of(cloud);
      ASSERT_EQ(positions.size(), 2u) << name;
      // In floats alone, northings have steps of 0.25 m.
      EXPECT_LT((positions[0] - start_m - Eigen::Vector3d(12, 0, 1)).norm(), 1e-4) << name;
      EXPECT_LT((positions[1] - start_m - Eigen::Vector3d(14.5, 0, 1)).norm(), 1e-4) << name;
      EXPECT_EQ(read_positions(cloud, [](auto) {}).not_finite, 1u);
    }
  }
}

// A pcap of the circle, and its poses somewhere else on Earth.
TEST(RecordedPositions, OfAPcapLieAlongItsTrajectory) {
  const TemporaryFolder folder;
  const fs::path pcap = folder.path() / "flight.pcap";
  if (find_format(pcap) == nullptr) GTEST_SKIP() << "built without libpcap";
  FlightRecord flight = testing::circle_flight();
  flight.body_from_lidar = mount_pose({0.02, 1.5, -0.03});
  const std::vector<scan::LabelledPoint> points = testing::scanned(flight);
  Source source;
  source.path = pcap;
  source.flight = flight;
  const auto writer = find_format(pcap)->create(pcap, source, {});
  writer->write(points);
  writer->close();
  const fs::path tum = folder.path() / "poses.tum";
  scan::write_tum(tum, scan::moved(flight.reported, kUtm));
  CloudFiles cloud(pcap);
  EXPECT_THAT(refusal(cloud), HasSubstr("flight.pcap: does not say where the sensor was"));
  cloud.recording = {.trajectory = tum,
                     .mount_rpy_deg = Eigen::Vector3d(0.02, 1.5, -0.03) / kDegrees};
  const auto positions = positions_of(cloud);
  ASSERT_EQ(positions.size(), points.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d truth = kUtm + testing::position(points[i]);
    // 0.015 degrees at 40 m, and the 2 mm steps of the ranges.
    ASSERT_LT((positions[i] - truth).norm(), 0.012) << i;
  }
  // Half of the trajectory, and the other half without a quarter of the whole.
  EXPECT_TRUE(read_cloud_system(cloud).notes.empty());
  const std::vector<scan::StampedPose>& poses = flight.reported.poses();
  const double end_s = poses.back().time_s;
  const auto only = [&](const auto& kept) {
    std::vector<scan::StampedPose> some;
    std::ranges::copy_if(poses, std::back_inserter(some), kept);
    scan::write_tum(tum, scan::moved(scan::Trajectory(some), kUtm));
  };
  only([&](const scan::StampedPose& pose) { return pose.time_s <= end_s / 2; });
  const auto until_half = std::ranges::count_if(
      points, [&](const scan::LabelledPoint& point) { return point.time <= end_s / 2 + 0.1; });
  const std::vector<Eigen::Vector3d> half = positions_of(cloud);
  EXPECT_NEAR(static_cast<double>(half.size()), static_cast<double>(until_half),
              0.01 * static_cast<double>(points.size()));
  EXPECT_EQ(read_positions(cloud, [](auto) {}).not_finite, points.size() - half.size());
  std::vector<scan::StampedPose> late = poses;
  for (std::size_t i = late.size() / 2; i < late.size(); ++i) late[i].time_s += 2;
  scan::write_tum(tum, scan::moved(scan::Trajectory(late), kUtm));
  EXPECT_THAT(read_cloud_system(cloud).notes, Contains(HasSubstr("has no pose for 2.0 s")));
  scan::write_tum(tum, scan::moved(flight.reported, kUtm));
  cloud.crs = "EPSG:32617";
  EXPECT_EQ(read_cloud_system(cloud).crs, "EPSG:32617");
  cloud.crs = "EPSG:4326";
  EXPECT_THAT(message_of<InputError>([&] { read_cloud_system(cloud); }), HasSubstr("in metres"));
}

TEST(RecordedPositions, PointsWithoutATimeAreLeftOut) {
  const TemporaryFolder folder;
  const CloudFiles cloud(write_ros(folder.path() / "flight.bag", {0, 0, 0}, std::nanf("")));
  for (const Eigen::Vector3d& position : positions_of(cloud)) EXPECT_TRUE(position.allFinite());
  EXPECT_EQ(read_positions(cloud, [](auto) {}).not_finite, 1u);
}

// Each is named, whatever comes after it.
TEST(RecordedPositions, RecordingsWithoutTransformsAreNamed) {
  const TemporaryFolder folder;
  const auto still = [&](const char* name) {
    auto writer = testing::create_file(folder.path() / name,
                                       {{.name = "/points", .type = ros::PointCloud2::kType}});
    auto cloud = labelled_cloud({.stamp = {1'000'000'000}, .frame_id = "lidar"});
    add_point(cloud, {}, {2, 0, 0}, 0);
    writer->write(0, {1'000'000'000}, ros::encode(writer->version(), cloud));
    writer->close();
    return folder.path() / name;
  };
  const CloudFiles cloud(std::vector<fs::path>{still("first.bag"), still("second.bag"),
                                               write_ros(folder.path() / "third.bag", {0, 0, 0})});
  const std::vector<std::string> notes = read_cloud_system(cloud).notes;
  EXPECT_THAT(notes, Contains(HasSubstr("no transform of first.bag")));
  EXPECT_THAT(notes, Contains(HasSubstr("no transform of second.bag")));
  EXPECT_THAT(notes, Not(Contains(HasSubstr("third.bag"))));
}

// Clouds in doubles whose frame is the map grid's, and floats in a local frame that a static
// transform puts there.
TEST(RecordedPositions, OfCloudsThatStandStillAreExactInMapGrids) {
  const TemporaryFolder folder;
  const Eigen::Vector3d local_m(3.25, -1.5, 0.75);
  const auto written = [&](const std::string& name, bool doubles) {
    auto writer = testing::create_file(folder.path() / name,
                                       {{.name = "/tf_static", .type = ros::TFMessage::kType},
                                        {.name = "/points", .type = ros::PointCloud2::kType}});
    if (!doubles) {
      ros::TransformStamped still;
      still.header = {.stamp = {kSecond_ns}, .frame_id = "utm"};
      still.child_frame_id = "map";
      still.transform.translation = {kUtm.x(), kUtm.y(), kUtm.z()};
      still.transform.rotation = {0, 0, 0, 1};
      writer->write(0, {kSecond_ns}, ros::encode(writer->version(), ros::TFMessage{{still}}));
    }
    auto cloud = labelled_cloud({.stamp = {kSecond_ns}, .frame_id = "map"});
    if (doubles) {
      const Eigen::Vector3d place_m = kUtm + local_m;
      cloud = {.header = cloud.header, .width = 1, .point_step = 24, .row_step = 24};
      for (const char* axis : {"x", "y", "z"})
        cloud.point_fields.push_back(
            {.name = axis,
             .offset = static_cast<std::uint32_t>(8 * cloud.point_fields.size()),
             .datatype = ros::PointField::kFloat64,
             .count = 1});
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(place_m.data());
      cloud.data.assign(bytes, bytes + 24);
      cloud.height = 1;
    } else {
      add_point(cloud, {}, local_m.cast<float>(), 0);
    }
    writer->write(1, {kSecond_ns}, ros::encode(writer->version(), cloud));
    writer->close();
    return folder.path() / name;
  };
  for (const char* name : {"still.bag", "still.mcap"}) {
    for (const bool doubles : {false, true}) {
      const auto positions = positions_of(CloudFiles(written(name, doubles)));
      ASSERT_EQ(positions.size(), 1u);
      EXPECT_LT((positions[0] - kUtm - local_m).norm(), 1e-4) << name << doubles;
    }
  }
}

// A time of 1e30 s is in no year.
TEST(RecordedPositions, AbsurdTimesHaveNoDate) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "flight.bag";
  auto writer = testing::create_file(file, {{.name = "/points", .type = ros::PointCloud2::kType}});
  auto cloud = labelled_cloud({.stamp = {kSecond_ns}, .frame_id = "lidar"});
  for (const float time_s : {1e30F, 0.5F, -1e30F}) add_point(cloud, {}, {2, 0, 0}, time_s);
  writer->write(0, {kSecond_ns}, ros::encode(writer->version(), cloud));
  writer->close();
  const scan::CloudFacts facts = read_cloud_facts(CloudFiles(file), [](auto) {});
  EXPECT_EQ(facts.points, 3u);
  ASSERT_TRUE(facts.utc.has_value());
  EXPECT_EQ(format_utc((*facts.utc)[0]), "1970-01-01T00:00:01.5Z");
  EXPECT_EQ((*facts.utc)[0], (*facts.utc)[1]);
}

TEST(RecordedPositions, FactsAreOfTheRecording) {
  const TemporaryFolder folder;
  const CloudFiles cloud(write_ros(folder.path() / "flight.bag", kUtm));
  const scan::CloudFacts facts = read_cloud_facts(cloud, [](auto) {});
  EXPECT_EQ(facts.format, "ROS 1 bag");
  EXPECT_EQ(facts.points, 2u);
  EXPECT_EQ(facts.not_finite, 1u);
  EXPECT_LT((facts.bounds.max() - kUtm - Eigen::Vector3d(14.5, 0, 1)).norm(), 1e-4);
  EXPECT_THAT(facts.fields, Contains("time"));
  EXPECT_FALSE(facts.classes);  // a simulation's labels are no classification
  ASSERT_TRUE(facts.time_s && facts.utc);
  EXPECT_NEAR((*facts.time_s)[1], 1.25, 1e-9);
  EXPECT_EQ(format_utc((*facts.utc)[0]), "1970-01-01T00:00:02Z");
}

TEST(RecordedPositions, WhatMeansNothingIsRefused) {
  const TemporaryFolder folder;
  const fs::path bag = write_ros(folder.path() / "flight.bag", {0, 0, 0});
  const fs::path text = folder.write("cloud.xyz", "0 0 0\n1 1 1\n");
  CloudFiles cloud(std::vector<fs::path>{bag, text});
  EXPECT_THAT(refusal(cloud), HasSubstr("cloud.xyz: is a cloud, and others are recordings"));
  cloud = CloudFiles(text);
  cloud.recording.topic = "/points";
  EXPECT_THAT(refusal(cloud), HasSubstr("tell of a recording"));
  cloud = CloudFiles(bag);
  cloud.recording.trajectory = text;
  EXPECT_THAT(refusal(cloud), HasSubstr("holds its own poses"));
  cloud.recording = {.topic = "/none"};
  EXPECT_THAT(refusal(cloud), HasSubstr("no clouds of topic /none; it has /points"));
  cloud.recording = {};
  cloud.leave_out_classes = {2};
  EXPECT_THAT(refusal(cloud), HasSubstr("its points have no classes"));
}

}  // namespace
}  // namespace plotscan::record
