// SPDX-License-Identifier: Apache-2.0
#include "cloud/cloud_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::cloud {
namespace {

using plotscan::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CloudMap, KeepsWhatLiesInItsArea) {
  CloudMap map({0, 0, 10, 10});
  map.add(std::vector<Eigen::Vector3d>{{1, 1, 0}, {11, 1, 0}, {1, -0.1, 0}});
  map.add(std::vector<Eigen::Vector3d>{{10, 10, 2}});
  EXPECT_EQ(map.points().size(), 2u);
  EXPECT_EQ(map.points_read(), 4u);
}

TEST(CloudMap, KeepsMillimetresInMapGridCoordinates) {
  CloudMap map({499990, 4999990, 500010, 5000010});
  const Eigen::Vector3d point(500003.123, 5000004.567, 512.345);
  map.add(std::vector{point});
  EXPECT_LT((map.origin() + map.points().front().cast<double>() - point).norm(), 1e-5);
}

TEST(CloudMap, StrayPointsDoNotCoarsenTheOthers) {
  CloudMap map({0, 0, 10, 10});
  map.add(std::vector<Eigen::Vector3d>{{1, 1, 1e9}, {2, 2, 0.125}, {3, 3, 0.25}, {99, 99, -1e8}});
  ASSERT_EQ(map.points().size(), 2u);
  EXPECT_NEAR(map.origin().z() + map.points()[1].z(), 0.25, 1e-6);
}

TEST(CloudMap, RefusesAreasThatAreNone) {
  EXPECT_THAT(message_of<InputError>([] {
                require_area({0, 0, -1, 5}, "crop box");
              }),
              HasSubstr("crop box 0,0,-1,5 is no rectangle"));
  EXPECT_THAT(message_of<InputError>([] {
                require_area({0, 0, 1, 20000}, "crop box");
              }),
              HasSubstr("longer than 10 km"));
  EXPECT_THROW(require_area({0, 0, 1, std::nan("")}, "crop box"), InputError);
}

TEST(CloudMap, SaysOfAFieldTooLongThatItsUnitsMayBeOthers) {
  EXPECT_NO_THROW(require_scanned_area({0, 0, 80, 80}, "field.ply"));
  EXPECT_THAT(message_of<InputError>([] {
                require_scanned_area({0, 0, 80000, 80000}, "field.ply");
              }),
              AllOf(HasSubstr("field.ply: the scanned field"), HasSubstr("longer than 10 km"),
                    HasSubstr("--units")));
}

std::string pcd_of(const std::string& rows, int count) {
  return "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
         std::to_string(count) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         std::to_string(count) + "\nDATA ascii\n" + rows;
}

// 20 points in each square metre of 6 x 4, one in each of a hundred around them.
TEST(ReadMap, FindsTheDenselyScannedField) {
  std::string rows;
  int count = 0;
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 14; ++y) {
      const bool dense = x >= 5 && x < 11 && y >= 5 && y < 9;
      for (int i = 0; i < (dense ? 20 : 1); ++i, ++count)
        rows += std::to_string(x + 0.04 * i + 0.1) + " " + std::to_string(y + 0.5) + " 0\n";
    }
  }
  const plotscan::testing::TemporaryFolder folder;
  const CloudMap map = read_map(folder.write("cloud.pcd", pcd_of(rows, count)), {});
  EXPECT_THAT(map.area(), ElementsAre(4, 4, 12, 10));  // a square more on every side
  EXPECT_EQ(map.points().size(), 6u * 4u * 20u + 8u * 6u - 6u * 4u);
}

TEST(ReadMap, SaysWhatTheMapWasNotGiven) {
  const plotscan::testing::TemporaryFolder folder;
  const auto file = folder.write("cloud.pcd", pcd_of("1 2 3\n4 nan 6\n70 80 9\n", 3));
  const CloudMap map = read_map(file, NamedArea{{0, 0, 10, 10}});
  EXPECT_EQ(map.points_read(), 2u);
  EXPECT_EQ(map.not_given().not_finite, 1u);
}

TEST(ReadMap, ReadsACropBoxFromAFile) {
  const plotscan::testing::TemporaryFolder folder;
  const auto file = folder.write("cloud.pcd", pcd_of("1 2 3\n4 5 6\n70 80 9\n", 3));
  const CloudMap map = read_map(file, NamedArea{{0, 0, 10, 10}});
  EXPECT_EQ(map.points_read(), 3u);
  ASSERT_EQ(map.points().size(), 2u);
  EXPECT_LT((map.origin() + map.points()[1].cast<double>() - Eigen::Vector3d(4, 5, 6)).norm(),
            1e-6);
  EXPECT_THAT(message_of<InputError>([&] {
                read_map(file, NamedArea{{-9, -9, -8, -8}});
              }),
              HasSubstr("none of its 3 points lies in the crop box -9,-9,-8,-8"));
  EXPECT_THAT(message_of<InputError>([&] {
                read_map(file, NamedArea{{-9, -9, -8, -8}, "given boxes"});
              }),
              HasSubstr("lies in the given boxes -9,-9,-8,-8"));
}

}  // namespace
}  // namespace plotscan::cloud
