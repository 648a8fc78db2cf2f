// SPDX-License-Identifier: Apache-2.0
#include "scan/point_reader.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scan/cloud_facts.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

std::vector<LabelledPoint> points_of(const std::filesystem::path& file) {
  std::vector<LabelledPoint> points;
  read_points(file, read_cloud_info(file), [&](std::span<const LabelledPoint> piece) {
    points.insert(points.end(), piece.begin(), piece.end());
  });
  return points;
}

std::string ply(const std::string& properties, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
         "property float z\n" +
         properties + "end_header\n" + body + "\n";
}

TEST(PointReader, KnowsFieldsByTheirNamesInOtherProgramsAndConvertsTypes) {
  const TemporaryFolder folder;
  const auto file = folder.write("cloud.ply", ply("property uchar scalar_Intensity\n"
                                                  "property float Ring\nproperty double GpsTime\n"
                                                  "property int ReturnNumber\n"
                                                  "property short number_of_returns\n"
                                                  "property char label\nproperty double plot\n"
                                                  "property ushort plant\nproperty uchar red\n",
                                                  "1 2 3 200 15 0.125 2 3 3 4000000001 70 9"));
  const auto points = points_of(file);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].z, 3);
  EXPECT_EQ(points[0].intensity, 200);
  EXPECT_EQ(points[0].ring, 15);
  EXPECT_EQ(points[0].time, 0.125);
  EXPECT_EQ(points[0].return_number, 2);
  EXPECT_EQ(points[0].return_count, 3);
  EXPECT_EQ(points[0].label, PointClass::weed);
  EXPECT_EQ(points[0].plot, 4000000001u);
  EXPECT_EQ(points[0].plant, 70u);
  EXPECT_THAT(read_cloud_info(file).fields,
              ::testing::ElementsAre("intensity", "ring", "time", "return_number", "return_count",
                                     "class", "plot", "plant"));
}

TEST(PointReader, AbsentFieldsKeepTheirDefaults) {
  const TemporaryFolder folder;
  const auto file = folder.write("cloud.ply", ply("", "1 2 3"));
  const LabelledPoint point = points_of(file).at(0);
  EXPECT_EQ(point.return_number, 1);
  EXPECT_EQ(point.return_count, 1);
  EXPECT_EQ(point.label, PointClass::unlabelled);
  EXPECT_TRUE(read_cloud_info(file).fields.empty());
}

// `estimator info` says the same of a cloud's times as the points have.
TEST(PointReader, FactsCountTimesInTheSameUnit) {
  const TemporaryFolder folder;
  const auto of = [&](const std::string& property, const std::string& time) {
    const CloudFiles file(folder.write("cloud.ply", ply(property, "0 0 0 " + time)));
    return read_cloud_facts(file, [](auto) {}).time_s.value().front();
  };
  EXPECT_NEAR(of("property uint t\n", "250000000"), 0.25, 1e-12);
  EXPECT_EQ(of("property double time\n", "250000000"), 250000000);
}

TEST(PointReader, ClassificationIsAsprsAndWholeTimesAreNanoseconds) {
  const TemporaryFolder folder;
  const std::string properties = "property uchar Classification\nproperty uint t\n";
  const auto of = [&](const std::string& body) {
    return points_of(folder.write("cloud.ply", ply(properties, "0 0 0 " + body))).at(0);
  };
  EXPECT_EQ(of("2 250000000").label, PointClass::ground);
  EXPECT_EQ(of("2 250000000").time, 0.25);
  EXPECT_EQ(of("4 0").label, PointClass::crop);
  EXPECT_EQ(of("6 0").label, PointClass::other);
  EXPECT_EQ(of("1 0").label, PointClass::unlabelled);
}

TEST(PointReader, DoublesOfUtmKeepTheirMillimetres) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("cloud.pcd",
                   "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 3\nDATA ascii\nnan 0 0\n"
                   "553123.4567 4122678.9123 610.0005\n553023.1 4122600.25 609.5\n");
  const CloudInfo info = read_cloud_info(file);
  EXPECT_EQ(info.origin_m, Eigen::Vector3d(553000, 4123000, 1000));
  const auto points = points_of(file);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(info.origin_m.x() + points[0].x, 553123.4567, 2e-5);
  EXPECT_NEAR(info.origin_m.y() + points[0].y, 4122678.9123, 2e-5);
  EXPECT_NEAR(info.origin_m.z() + points[0].z, 610.0005, 2e-5);
}

TEST(PointReader, FloatsStayAsTheyAre) {
  const TemporaryFolder folder;
  const auto file = folder.write("cloud.ply", ply("", "5000.25 -0.1 1e-7"));
  EXPECT_EQ(read_cloud_info(file).origin_m, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(points_of(file).at(0).x, 5000.25f);
  EXPECT_EQ(points_of(file).at(0).z, 1e-7f);
}

TEST(PointReader, NumbersThatDoNotFitAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& property, const std::string& value) {
    const auto file =
        folder.write("cloud.ply", ply("property " + property + "\n", "1 2 3 " + value));
    return message_of<InputError>([&] { points_of(file); });
  };
  EXPECT_THAT(refusal("uint ring", "70000"),
              HasSubstr("cloud.ply: point 1: \"ring\" is 70000, which is no ring"));
  EXPECT_THAT(refusal("int plot", "-1"), HasSubstr("\"plot\" is -1"));
  EXPECT_THAT(refusal("float plant", "nan"), HasSubstr("\"plant\" is nan"));
  EXPECT_THAT(refusal("double time", "inf"), HasSubstr("\"time\" is inf"));
}

}  // namespace
}  // namespace plotscan::scan
