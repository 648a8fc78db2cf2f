// SPDX-License-Identifier: Apache-2.0
#include "record/scan_folder.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "lidar/fly.h"
#include "lidarsim/lidar/small_farm.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

TEST(ScanFolder, SaysHowThePointsWerePlaced) {
  const TemporaryFolder folder;
  farm::Farm farm = testing::small_farm();
  farm.anchor = Anchor{.latitude_deg = 37.2, .longitude_deg = -80.5, .altitude_m = 610};
  const lidar::FlyOptions options{
      .start_utc = "2025-07-01T08:30:00Z", .spin_hz = 20, .mount_rpy_deg = {10, 80, -20}};
  const auto summary = lidar::fly(farm, folder.path() / "scan", options);
  const FlightRecord flight = read_flight_record(folder.path() / "scan");
  EXPECT_EQ(flight.sensor.name, "vlp16");
  EXPECT_EQ(flight.spin_hz, 20);
  EXPECT_TRUE(
      flight.body_from_lidar.isApprox(mount_pose(Eigen::Vector3d(10, 80, -20) * kDegrees), 1e-12));
  EXPECT_EQ(format_utc(flight.start), "2025-07-01T08:30:00Z");
  EXPECT_EQ(flight.anchor->latitude_deg, 37.2);
  EXPECT_EQ(flight.anchor->altitude_m, 610);
  EXPECT_EQ(flight.reported.end_s(), summary.duration_s);
  EXPECT_EQ(flight.placed().sequences() * flight.placed().lasers(), summary.shots);
}

TEST(ScanFolder, AnotherFolderIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { read_flight_record(folder.path()); }),
              HasSubstr("no manifest.json"));
  std::ofstream(folder.path() / "manifest.json") << R"({"options": {"sensor": "vlp16"}})";
  EXPECT_THAT(message_of<InputError>([&] { read_flight_record(folder.path()); }),
              HasSubstr("is no scan folder: it has no sensor.yaml"));
}

}  // namespace
}  // namespace plotscan::record
