// SPDX-License-Identifier: Apache-2.0
// PCL's driver of the VLP-16 replays our recordings.
#include <chrono>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>
#include <pcl/io/vlp_grabber.h>

#include "core/angle.h"
#include "lidarsim/record/flown_scan.h"
#include "record/velodyne/internal/pcap_writer.h"

namespace plotscan::record {
namespace {

using testing::FlownScan;
using testing::Measured;

// The points of every whole sweep, waited for until there are as many as expected; it replays in
// real time. What it has after a minute is handed back whatever it is.
std::vector<pcl::PointXYZI> grabbed(const std::filesystem::path& file, std::size_t expected) {
  std::mutex mutex;
  std::vector<pcl::PointXYZI> points;
  pcl::VLPGrabber grabber(file.string());
  const std::function<void(const pcl::PointCloud<pcl::PointXYZI>::ConstPtr&)> collect =
      [&](const pcl::PointCloud<pcl::PointXYZI>::ConstPtr& sweep) {
        const std::scoped_lock lock(mutex);
        points.insert(points.end(), sweep->begin(), sweep->end());
      };
  const auto connection = grabber.registerCallback(collect);
  grabber.start();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  const auto is_done = [&] {
    const std::scoped_lock lock(mutex);
    return points.size() >= expected;
  };
  while (!is_done() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  grabber.stop();
  return points;
}

TEST(VlpGrabber, SeesTheFlightsRangesAndAngles) {
  const FlownScan scan;
  const auto file = scan.folder.path() / "flight.pcap";
  const auto writer = create_pcap(file, scan.flight);
  writer->write(scan.points);
  writer->close();
  // It hands a sweep on when the next one begins: the last is not seen. The azimuth is that of the
  // firing sequence, as it does not turn on from laser to laser.
  const std::vector<Measured> all = testing::measured(scan);
  const double sequence_deg = 360 * scan.flight.spin_hz * scan.flight.sensor.sequence_s;
  const auto turn = [&](const Measured& shot) {
    return std::floor((sequence_deg * static_cast<double>(shot.sequence) + 0.005) / 360);
  };
  std::vector<Measured> expected;
  for (const Measured& shot : all)
    if (turn(shot) < turn(all.back())) expected.push_back(shot);
  ASSERT_GT(expected.size(), 50'000U);

  const auto points = grabbed(file, expected.size());
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d way = points[i].getVector3fMap().cast<double>();
    const sensor::Laser& laser = scan.flight.sensor.lasers[expected[i].laser];
    ASSERT_NEAR(way.norm(), expected[i].range_m, 1e-4);
    ASSERT_NEAR(std::asin(way.z() / way.norm()), laser.elevation_rad, 1e-5);
    // Its y axis is at azimuth 0 and its x axis at 90 degrees: our x and -y. It cuts azimuths off
    // to hundredths of a degree after halving the way from block to block.
    const double azimuth_deg = std::atan2(way.x(), way.y()) / kDegrees;
    const double sequence_azimuth_deg = sequence_deg * static_cast<double>(expected[i].sequence);
    ASSERT_LT(testing::azimuth_error_deg(azimuth_deg, sequence_azimuth_deg), 0.0201);
    ASSERT_EQ(points[i].intensity, scan.points[i].intensity);
  }
}

}  // namespace
}  // namespace plotscan::record
