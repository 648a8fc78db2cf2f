// SPDX-License-Identifier: Apache-2.0
#include "plotscan/clouds.h"

#include <limits>

#include <gmock/gmock.h>

#include "plotscan/data.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::vector<Point> some_points() {
  std::vector<Point> points;
  for (int i = 0; i < 1000; ++i) {
    points.push_back({.x = 0.5F * static_cast<float>(i),
                      .y = -0.25F * static_cast<float>(i % 7),
                      .z = 0.125F,
                      .intensity = static_cast<float>(i % 256),
                      .ring = static_cast<std::uint16_t>(i % 16),
                      .time = 0.001 * i,
                      .return_number = 1,
                      .return_count = 2,
                      .label = 2,
                      .plot = 3,
                      .plant = static_cast<std::uint32_t>(i)});
  }
  return points;
}

TEST(LibraryClouds, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  const std::vector<Point> points = some_points();
  for (const char* name : {"a.pcd", "a.ply"}) {
    write_cloud(folder.path() / name, points);
    const Cloud cloud = read_cloud(folder.path() / name);
    EXPECT_EQ(cloud.points, points) << name;
    EXPECT_THAT(cloud.origin_m, ElementsAre(0, 0, 0)) << name;
  }
  write_cloud(folder.path() / "a.las", points);
  const Cloud las = read_cloud(folder.path() / "a.las");
  ASSERT_EQ(las.points.size(), points.size());
  EXPECT_NEAR(las.positions()[999][0], 499.5, 1e-4);
  EXPECT_EQ(las.points[999].label, 2);
}

TEST(LibraryClouds, KeepOriginsOfHundredsOfKilometres) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "far.pcd";
  write_cloud(file, some_points(), {.origin_m = {500'000, 4'100'000, 300}});
  const auto point = read_cloud(file).positions()[1];
  EXPECT_NEAR(point[0], 500'000.5, 1e-4);
  EXPECT_NEAR(point[1], 4'099'999.75, 1e-4);
  EXPECT_NEAR(point[2], 300.125, 1e-4);
}

TEST(LibraryClouds, AreConverted) {
  const TemporaryFolder folder;
  write_cloud(folder.path() / "a.pcd", some_points());
  EXPECT_EQ(convert_cloud(folder.path() / "a.pcd", folder.path() / "b.ply", {.encoding = "ascii"}),
            1000u);
  EXPECT_EQ(read_cloud(folder.path() / "b.ply").points.size(), 1000u);
}

template <class Work>
std::string refused(const Work& work) {
  try {
    work();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

// No reader would take the file.
TEST(LibraryClouds, AreNotWrittenWithNumbersThatAreNone) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto written = [&](const Point& last, const WriteCloudOptions& options = {}) {
    std::vector<Point> points = some_points();
    points.push_back(last);
    return refused([&] { write_cloud(folder.path() / "a.pcd", points, options); });
  };
  EXPECT_THAT(written({.time = nan}), HasSubstr("point 1001 of 1001 has the time nan"));
  EXPECT_THAT(written({.intensity = nan}), HasSubstr("the intensity nan"));
  EXPECT_THAT(written({}, {.origin_m = {0, nan, 0}}), HasSubstr("origin_m"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.pcd"));
  EXPECT_EQ(written({.z = nan}), "nothing thrown");  // PCD has points without a place
  EXPECT_EQ(read_cloud(folder.path() / "a.pcd").points.size(), 1000u);
  const std::vector<Point> lost = {{.z = nan}};
  EXPECT_THAT(refused([&] { write_cloud(folder.path() / "a.las", lost); }),
              HasSubstr("point 1 has no finite x, y and z"));
}

// A header of 10^12 points in a file of 200 bytes.
TEST(LibraryClouds, TakeNoMemoryForWhatAHeaderPromises) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "huge.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n" +
          std::string(120, '\0'));
  EXPECT_THAT(refused([&] { read_cloud(file); }), HasSubstr("huge.ply: is truncated"));
}

TEST(LibraryClouds, RefuseWhatCannotBe) {
  const TemporaryFolder folder;
  const auto file = folder.write("there.pcd", "x");
  EXPECT_THAT(refused([&] { write_cloud(file, some_points()); }), HasSubstr("exists"));
  EXPECT_THAT(refused([&] { write_cloud(folder.path() / "a.xls", some_points()); }),
              HasSubstr("must end in one of"));
  EXPECT_THAT(refused([&] { write_cloud(folder.path() / "a.txt", some_points()); }),
              HasSubstr("a.txt: cannot be written: .txt is a trajectory's here; points are written "
                        "into a file whose name ends in one of .pcd, .ply"));
  EXPECT_THAT(refused([&] { write_cloud(folder.path() / "a.bag", some_points()); }),
              HasSubstr("needs the flight"));
  EXPECT_THAT(refused([&] { read_cloud(folder.path() / "none.las"); }), HasSubstr("none.las"));
  EXPECT_THAT(refused([&] { read_cloud(file); }), HasSubstr("there.pcd"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.bag"));
}

TEST(LibraryData, IsTheSourcesInABuildTree) {
  EXPECT_TRUE(std::filesystem::equivalent(shipped_data(), PLOTSCAN_SOURCE_DIR));
  EXPECT_FALSE(library_version().empty());
}

}  // namespace
}  // namespace plotscan
