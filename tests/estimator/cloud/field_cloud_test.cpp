// SPDX-License-Identifier: Apache-2.0
#include "cloud/field_cloud.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/random.h"
#include "temporary_folder.h"

namespace plotscan::cloud {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

using WorldPoints = std::vector<Eigen::Vector3d>;

WorldPoints field_points(std::size_t count, const Eigen::Vector3d& centre) {
  RandomStream random(1, random_purpose("test/field_cloud"), 0);
  WorldPoints points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(centre + Eigen::Vector3d(random.uniform(-10, 10), random.uniform(-5, 5),
                                              random.uniform(0, 1)));
  // Of a length that a move by whole metres does not round.
  for (Eigen::Vector3d& point : points) point = (point * 0x1p20).array().round() * 0x1p-20;
  return points;
}

FieldCloud field_of(const WorldPoints& points, const FieldOptions& options = {}) {
  TileStore store({.points_per_cell = options.points_per_cell, .threads = options.threads});
  store.add(points);
  return take_field(store, options, "points");
}

std::string pcd_text(const WorldPoints& points) {
  std::string text = "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
                     std::to_string(points.size()) + "\nHEIGHT 1\nDATA ascii\n";
  for (const Eigen::Vector3d& p : points)
    text += format_number(p.x()) + " " + format_number(p.y()) + " " + format_number(p.z()) + "\n";
  return text;
}

TEST(FieldCloud, IsTheSameInAnyOrderAndMovedByWholeMetres) {
  WorldPoints points = field_points(20000, {0, 0, 0});
  const FieldCloud field = field_of(points);
  EXPECT_EQ(field.points.size(), 20000u);
  std::shuffle(points.begin(), points.end(), std::mt19937(1));
  EXPECT_EQ(field_of(points, {.threads = 2}).points, field.points);
  const Eigen::Vector3d move(500000, 4100000, 512);
  for (Eigen::Vector3d& point : points) point += move;
  const FieldCloud moved = field_of(points);
  EXPECT_EQ(moved.points, field.points);
  EXPECT_EQ(moved.origin - field.origin, move);
}

TEST(FieldCloud, KeepsATenthOfAMillimetreInMapGridCoordinates) {
  const TemporaryFolder folder;
  WorldPoints points;  // apart in x, to be known again
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(512345.6789 + 0.0061 * i, 4123456.7891 + 0.0017 * (i * 7 % 1999),
                        1234.5678 + 0.0001 * (i % 777));
  const FieldCloud field = read_field(folder.write("cloud.pcd", pcd_text(points)), {});
  ASSERT_EQ(field.points.size(), points.size());
  const auto by_x = [](const auto& p) { return p.x(); };
  std::vector<Eigen::Vector3d> read;
  for (const Eigen::Vector3f& p : field.points) read.push_back(field.origin + p.cast<double>());
  std::ranges::sort(read, {}, by_x);
  std::ranges::sort(points, {}, by_x);
  double worst_m = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst_m = std::max(worst_m, (read[i] - points[i]).cwiseAbs().maxCoeff());
  EXPECT_LT(worst_m, 1e-4);
}

TEST(FieldCloud, SaysWhatBecameOfEachPoint) {
  const TemporaryFolder folder;
  WorldPoints points = field_points(2000, {0, 0, 0});
  points.insert(points.end(), points.begin(), points.begin() + 10);
  points.emplace_back(0, std::nan(""), 0);
  points.emplace_back(4000, 300, 0);
  points.emplace_back(0, 1e20, 0);
  const FieldCloud field = read_field(folder.write("cloud.pcd", pcd_text(points)), {});
  EXPECT_EQ(field.counts.read, 2013u);
  EXPECT_EQ(field.counts.not_finite, 1u);
  EXPECT_EQ(field.counts.outside, 2u);
  EXPECT_EQ(field.counts.repeated, 10u);
  EXPECT_EQ(field.counts.thinned, 0u);
  EXPECT_EQ(field.counts.kept, 2000u);
  EXPECT_EQ(field.points.size(), 2000u);
}

TEST(FieldCloud, HasTheSameDensityIfEveryPointIsThereTwice) {
  WorldPoints points = field_points(20000, {0, 0, 0});
  const double once_m2 = field_of(points, {}).density_m2;
  EXPECT_GT(once_m2, 1);
  points.insert(points.end(), points.begin(), points.begin() + 20000);
  EXPECT_EQ(field_of(points, {}).density_m2, once_m2);
}

TEST(FieldCloud, TakesTheCropBoxToThePoint) {
  const WorldPoints points = field_points(20000, {0, 0, 0});
  const Area area{-3.25, -2.5, 4.125, 1.75};
  const FieldCloud field = field_of(points, {.area = area});
  EXPECT_EQ(field.area, area);
  const auto inside = std::ranges::count_if(points, [&](const Eigen::Vector3d& p) {
    return p.x() >= area[0] && p.x() <= area[2] && p.y() >= area[1] && p.y() <= area[3];
  });
  EXPECT_NEAR(static_cast<double>(field.points.size()), static_cast<double>(inside), 1);
  EXPECT_EQ(field.counts.outside + field.counts.kept, 20000u);
}

TEST(FieldCloud, RefusesPointsBeyondAnyPlace) {
  const TemporaryFolder folder;
  const auto file = folder.write("far.xyz", "1e300 0 0\n-1e299 1 0\n");
  EXPECT_THAT(message_of<InputError>([&] { read_field(file, {}); }),
              HasSubstr("far.xyz: its points lie beyond any place on Earth"));
}

TEST(FieldCloud, RefusesACropBoxWithoutPoints) {
  const TemporaryFolder folder;
  const auto file = folder.write("cloud.pcd", pcd_text(field_points(3, {0, 0, 0})));
  EXPECT_THAT(message_of<InputError>([&] {
                read_field(file, {.area = Area{90, 90, 91, 91}});
              }),
              HasSubstr("none of its 3 points lies in the crop box 90,90,91,91 (metres); they "
                        "lie in "));
  EXPECT_THAT(message_of<InputError>([&] {
                read_field(file, {.area = Area{90, 90, 91, 91}, .area_name = "given boxes"});
              }),
              HasSubstr("lies in the given boxes 90,90"));
  EXPECT_THROW(read_field(file, {.area = Area{1, 1, 0, 0}}), InputError);
}

// A map in longitude and latitude over a cloud in UTM of which nobody said so.
TEST(FieldCloud, HintsAtDegreesBesideAMapGrid) {
  const TemporaryFolder folder;
  const auto message = [&](const Eigen::Vector3d& place_m, const Area& area) {
    const auto file = folder.write("cloud.pcd", pcd_text(field_points(3, place_m)));
    return message_of<InputError>([&] { read_field(file, {.area = area}); });
  };
  const Eigen::Vector3d utm_m(553000, 4116000, 600);
  const Area degrees = {-80.4, 37.2, -80.3, 37.3};
  EXPECT_THAT(message(utm_m, degrees),
              HasSubstr("longitude and latitude: for a map of plots --crs"));
  EXPECT_THAT(message({0, 0, 0}, degrees), Not(HasSubstr("longitude")));
  EXPECT_THAT(message(utm_m, {553500, 4116000, 553600, 4116100}), Not(HasSubstr("longitude")));
}

}  // namespace
}  // namespace plotscan::cloud
