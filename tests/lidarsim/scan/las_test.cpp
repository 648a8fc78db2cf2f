// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "lidarsim/scan/numbered_point.h"
#include "readers/node_reader.h"
#include "scan/las_crs.h"
#include "scan/las_writer.h"
#include "scan/point_reader.h"
#include "scan/scan_angles.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

constexpr double kStep_m = 1e-4;

LasOptions plain_options() { return {.crs_wkt = local_crs_wkt()}; }

void write_las(const std::filesystem::path& file, const LasOptions& options,
               const std::vector<LabelledPoint>& points) {
  LasWriter writer(file, options);
  for (const LabelledPoint& point : points) writer.write({&point, 1});
  writer.close();
}

std::vector<LabelledPoint> points_in(const std::filesystem::path& file) {
  std::vector<LabelledPoint> points;
  read_points(file, read_cloud_info(file), [&](std::span<const LabelledPoint> piece) {
    points.insert(points.end(), piece.begin(), piece.end());
  });
  return points;
}

void expect_header(const json& read, std::uint32_t count) {
  const json& header = read["header"];
  EXPECT_EQ(header["minorVersion"], 4);
  EXPECT_EQ(header["pointDataRecordFormat"], 6);
  EXPECT_EQ(header["pointDataRecordLength"], 41);
  EXPECT_EQ(header["pointCount"], count);
  EXPECT_EQ(header["globalEncoding"], 17);  // WKT, adjusted standard GPS time
  EXPECT_EQ(header["pointCountByReturn"][0], (count + 1) / 2);
  EXPECT_EQ(header["pointCountByReturn"][1], count / 2);
  EXPECT_EQ(header["min"], (json{0.0, 1.0 - count, 0.0}));
  EXPECT_EQ(header["max"], (json{count - 1.0, 0.0, 0.125 * (count - 1.0)}));
  EXPECT_EQ(header["systemIdentifier"], "Velodyne VLP-16 (Puck)");
  EXPECT_THAT(header["generatingSoftware"].get<std::string>(), HasSubstr("Plotscan"));
  EXPECT_EQ(header["fileCreationDayOfYear"], 152);  // 2026-06-01
  EXPECT_EQ(header["fileCreationYear"], 2026);
  EXPECT_EQ(read["size"], read["end"]) << "bytes behind the points";
}

TEST(Las, ANodePackageReadsEveryField) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.las";
  constexpr std::uint32_t kCount = 1001;
  const UtcTime start = *parse_utc("2026-06-01T10:00:00Z");
  LasOptions options = plain_options();
  options.start = start;
  options.system = "Velodyne VLP-16 (Puck)";
  options.scan_angle_rad = [](const LabelledPoint& p) { return 1e-3 * (p.x - 500); };
  write_las(file, options, numbered_points(kCount));
  const auto read = testing::read_with_node("read_las.cjs", file);
  if (!read) GTEST_SKIP() << "needs node and tests/readers/node_modules: scripts/setup";
  ASSERT_TRUE(read->is_object());
  expect_header(*read, kCount);
  EXPECT_EQ((*read)["wkt"], local_crs_wkt());
  const json& points = (*read)["points"];
  const std::array<int, 5> asprs = {0, 2, 3, 3, 1};
  // GPS time is 18 s ahead of UTC: 2026-06-01 is day 16948 of it.
  const double gps_s = 16948 * 86400.0 + 36000 + 18 - 1e9;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const LabelledPoint p = numbered_point(i);
    ASSERT_NEAR(points["X"][i], p.x, 1e-9);
    ASSERT_NEAR(points["Y"][i], p.y, 1e-9);
    ASSERT_NEAR(points["Z"][i], p.z, kStep_m / 2 + 1e-9);
    ASSERT_EQ(points["Intensity"][i], 257 * (i % 256));
    ASSERT_EQ(points["ReturnNumber"][i], p.return_number);
    ASSERT_EQ(points["NumberOfReturns"][i], p.return_count);
    ASSERT_EQ(points["Classification"][i], asprs[i % 5]);
    ASSERT_NEAR(points["ScanAngle"][i], degrees(1e-3 * (i - 500.0)), 0.00301);
    ASSERT_EQ(points["PointSourceId"][i], 1);
    ASSERT_NEAR(points["GpsTime"][i].get<double>(), gps_s + p.time, 1e-7);
    ASSERT_EQ(points["ring"][i], p.ring);
    ASSERT_EQ(points["plot"][i], p.plot);
    ASSERT_EQ(points["plant"][i], p.plant);
    ASSERT_EQ(points["class"][i], static_cast<int>(p.label));
  }
}

TEST(Las, OurReaderReadsEveryField) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.las";
  for (const bool dated : {false, true}) {
    LasOptions options = plain_options();
    if (dated) options.start = *parse_utc("2026-06-01T10:00:00.25Z");
    write_las(file, options, numbered_points(1001));
    const CloudInfo info = read_cloud_info(file);
    EXPECT_EQ(info.start, options.start);
    EXPECT_EQ(read_cloud_system(file).start, options.start);
    EXPECT_EQ(info.crs_wkt, local_crs_wkt());
    const auto points = points_in(file);
    ASSERT_EQ(points.size(), 1001u);
    for (std::uint32_t i = 0; i < 1001; ++i) {
      LabelledPoint expected = numbered_point(i);
      EXPECT_NEAR(points[i].z, expected.z, kStep_m / 2 + 1e-5);
      EXPECT_NEAR(points[i].time, expected.time, dated ? 1e-7 : 0);
      expected.z = points[i].z;
      expected.time = points[i].time;
      ASSERT_EQ(points[i], expected) << i;
    }
  }
}

TEST(Las, FarCoordinatesKeepTheirTenthOfAMillimetre) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.las";
  LasOptions options = plain_options();
  options.offset_m = {553000, 4123000, 1000};
  write_las(file, options, {{.x = 123.4567f, .y = -0.1234f, .z = 7.5f}});
  EXPECT_EQ(read_cloud_info(file).origin_m, options.offset_m);
  const LabelledPoint point = points_in(file).at(0);
  EXPECT_NEAR(point.x, 123.4567, kStep_m);
  EXPECT_NEAR(point.y, -0.1234, kStep_m);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  read_positions(file, [&](std::span<const Eigen::Vector3d> p) { position = p.front(); });
  EXPECT_NEAR(position.x(), 553123.4567, kStep_m);
  EXPECT_THAT(message_of<InputError>([&] { write_las(file, options, {{.x = 3e5f}}); }),
              HasSubstr("point 1 lies more than 214 km"));
}

// To the left and right of a flight to the east and of one to the west, and of a hovering drone.
TEST(Las, ScanAnglesArePositiveToTheRightOfTheFlight) {
  const auto flight = [](double speed_m_s) {
    return Trajectory({{.time_s = 0, .position_m = {0, 0, 10}},
                       {.time_s = 10, .position_m = {10 * speed_m_s, 0, 10}}});
  };
  const Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  const auto angle_deg = [&](double speed_m_s, float y, float z) {
    const Trajectory trajectory = flight(speed_m_s);
    const LabelledPoint point{.x = static_cast<float>(5 * speed_m_s), .y = y, .z = z, .time = 5};
    return degrees(ScanAngles(trajectory, mount).angle_rad(point));
  };
  EXPECT_NEAR(angle_deg(2, 0, 0), 0, 1e-6);
  EXPECT_NEAR(angle_deg(2, -10, 0), 45, 1e-5);
  EXPECT_NEAR(angle_deg(2, 10, 0), -45, 1e-5);
  EXPECT_NEAR(angle_deg(-2, 10, 0), 45, 1e-5);
  EXPECT_NEAR(angle_deg(2, -10, 20), 135, 1e-5);
  EXPECT_NEAR(angle_deg(0, -10, 10), 90, 1e-5);
}

// A LAS of three points, broken at will.
class BrokenLas : public ::testing::Test {
 protected:
  BrokenLas() {
    write_las(folder_.path() / "whole.las", plain_options(), numbered_points(3));
    bytes_ = read_text(folder_.path() / "whole.las");
  }
  template <class T>
  std::string with(std::size_t offset, T value) const {
    std::string bytes = bytes_;
    std::memcpy(&bytes[offset], &value, sizeof value);
    return bytes;
  }
  std::string refusal(const std::string& bytes) const {
    const auto file = folder_.write("broken.las", bytes);
    return message_of<InputError>([&] { points_in(file); });
  }

  TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(BrokenLas, IsRefusedWithWhatIsWrong) {
  EXPECT_THAT(refusal(with<std::uint8_t>(25, 5)), HasSubstr("version 1.5"));
  EXPECT_THAT(refusal(with<std::uint8_t>(24, 2)), HasSubstr("version 2.4"));
  EXPECT_THAT(refusal(with<std::uint16_t>(94, 100)), HasSubstr("100 bytes: too few"));
  EXPECT_THAT(refusal(with<std::uint32_t>(96, 10)), HasSubstr("begin at byte 10"));
  EXPECT_THAT(refusal(with<std::uint32_t>(96, 4000000000)), HasSubstr("begin at byte 4000000000"));
  EXPECT_THAT(refusal(with<std::uint8_t>(104, 6 | 0x80)), HasSubstr("LAZ"));
  EXPECT_THAT(refusal(with<std::uint8_t>(104, 11)), HasSubstr("point format 11"));
  EXPECT_THAT(refusal(with<std::uint16_t>(105, 29)), HasSubstr("at least 30 bytes"));
  EXPECT_THAT(refusal(with<std::uint16_t>(105, 35)), HasSubstr("extra bytes do not fit"));
  EXPECT_THAT(refusal(with<double>(131, 0)), HasSubstr("scale factors"));
  EXPECT_THAT(refusal(with<double>(163, std::nan(""))), HasSubstr("offsets finite"));
  EXPECT_THAT(refusal(with<std::uint16_t>(375 + 20, 191)), HasSubstr("is broken"));
  EXPECT_THAT(refusal(with<std::uint8_t>(375 + 54 + 2, 31)), HasSubstr("type 31"));
  EXPECT_THAT(refusal(with<std::uint64_t>(247, 4)), HasSubstr("promises 4 points of 41 bytes"));
  EXPECT_THAT(refusal(with<std::uint64_t>(247, std::uint64_t{1} << 62)), HasSubstr("promises"));
  EXPECT_THAT(refusal(with<std::uint64_t>(247, 0)), HasSubstr("empty"));
  for (std::size_t size = 1; size < bytes_.size(); size += 7)
    EXPECT_NE(refusal(bytes_.substr(0, size)), "");
}

// The fields of version 1.2, format 1: three bits of returns, five of class, time at byte 20.
TEST_F(BrokenLas, OldVersionsAreRead) {
  std::string bytes(227, '\0');
  const auto put = [&bytes](std::size_t offset, auto value) {
    std::memcpy(&bytes[offset], &value, sizeof value);
  };
  std::memcpy(bytes.data(), "LASF", 4);
  put(24, std::uint8_t{1});
  put(25, std::uint8_t{2});
  put(94, std::uint16_t{227});
  put(96, std::uint32_t{227});
  put(104, std::uint8_t{1});
  put(105, std::uint16_t{28});
  put(107, std::uint32_t{1});
  for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.01);
  put(155, 500000.0);
  bytes.resize(227 + 28);
  put(227, std::int32_t{-150});
  put(231, std::int32_t{250});
  put(227 + 12, std::uint16_t{257 * 40});
  put(227 + 14, static_cast<std::uint8_t>(2 | 3 << 3 | 1 << 6));
  put(227 + 15, static_cast<std::uint8_t>(2 | 1 << 7));
  put(227 + 20, 345.5);
  const auto file = folder_.write("old.las", bytes);
  EXPECT_EQ(read_cloud_info(file).start, std::nullopt);
  const LabelledPoint expected{.x = -1.5f,
                               .y = 2.5f,
                               .intensity = 40,
                               .time = 345.5,
                               .return_number = 2,
                               .return_count = 3,
                               .label = PointClass::ground};
  EXPECT_EQ(points_in(file).at(0), expected);
}

}  // namespace
}  // namespace plotscan::scan
