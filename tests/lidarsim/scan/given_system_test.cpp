// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scan/cloud_reader.h"
#include "scan/las_crs.h"
#include "scan/las_writer.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

CloudFiles told(const std::filesystem::path& file, const std::string& crs) {
  CloudFiles cloud(file);
  cloud.crs = crs;
  return cloud;
}

std::string refusal(const CloudFiles& cloud) {
  return message_of<InputError>([&] { read_cloud_system(cloud); });
}

// A LAS of one point in zone 17N, which it states.
std::filesystem::path las(const TemporaryFolder& folder) {
  const auto file = folder.path() / "stated.las";
  LasWriter writer(file, {.crs_wkt = utm_crs_wkt({.number = 17, .north = true}),
                          .offset_m = {500000, 4000000, 0}});
  const LabelledPoint point{.x = 1, .y = 2, .z = 3};
  writer.write({&point, 1});
  writer.close();
  return file;
}

TEST(GivenSystem, SpeaksForAFileThatIsSilent) {
  const TemporaryFolder folder;
  const auto utm = folder.write("utm.xyz", "512345.25 4123456.5 7\n512346 4123457 8\n");
  const CloudSystem system = read_cloud_system(told(utm, "EPSG:25832"));
  EXPECT_EQ(system.crs, "EPSG:25832");
  EXPECT_EQ(system.units, CoordinateUnits{});
  EXPECT_THAT(system.notes, IsEmpty());
  EXPECT_EQ(system.metres_of({512345.25, 4123456.5, 7}), Eigen::Vector3d(512345.25, 4123456.5, 7));
}

// Where zone 17's meridian meets the equator, eastings are 500 km and northings 0.
TEST(GivenSystem, DegreesAreProjected) {
  const TemporaryFolder folder;
  const auto degrees = folder.write("degrees.xyz", "-81 0 7\n-81 0.001 8\n");
  const CloudSystem system = read_cloud_system(told(degrees, "EPSG:4326"));
  EXPECT_EQ(system.crs, "EPSG:32617");
  EXPECT_LT((system.metres_of({-81, 0, 7}) - Eigen::Vector3d(500000, 0, 7)).norm(), 1e-6);
  EXPECT_THAT(system.notes, ElementsAre(HasSubstr("zone 17N")));
}

TEST(GivenSystem, ContradictionsAreSaid) {
  const TemporaryFolder folder;
  const auto file = las(folder);
  EXPECT_THAT(read_cloud_system(told(file, "EPSG:32617")).notes, IsEmpty());
  const CloudSystem other = read_cloud_system(told(file, "EPSG:26917"));
  EXPECT_EQ(other.crs, "EPSG:26917");
  EXPECT_THAT(other.notes,
              ElementsAre("the file states EPSG:32617; its numbers are taken for EPSG:26917, as "
                          "--crs says"));
  const auto named = folder.write("named.csv", "lon,lat,z\n500000,4000000,1\n");
  EXPECT_THAT(read_cloud_system(told(named, "EPSG:32617")).notes,
              ElementsAre(HasSubstr("the file states degrees; its numbers are taken for")));
}

TEST(GivenSystem, WhatCannotBeIsRefused) {
  const TemporaryFolder folder;
  const auto local = folder.write("local.xyz", "12 -3 1\n");
  EXPECT_THAT(refusal(told(local, "EPSG:32617")),
              HasSubstr("local.xyz: its first point, x 12, y -3, is no place of --crs EPSG:32617"));
  const auto utm = folder.write("utm.xyz", "512345 4123456 7\n");
  EXPECT_THAT(refusal(told(utm, "EPSG:4326")), HasSubstr("is in degrees, as --crs EPSG:4326 says"));
  for (const char* unknown : {"EPSG:2284", "EPSG:32661", "32617", ""})
    EXPECT_THAT(refusal(told(utm, unknown)), HasSubstr("known are UTM on WGS 84"));
  CloudFiles feet = told(utm, "EPSG:32617");
  feet.units = {kFoot_m, kFoot_m};
  EXPECT_THAT(refusal(feet), HasSubstr("counts in metres, and --units says otherwise"));
  feet = told(folder.write("degrees.xyz", "-81 0 7\n"), "EPSG:4326");
  feet.units = CoordinateUnits{};
  EXPECT_THAT(refusal(feet), HasSubstr("counts in degrees, and --units says otherwise"));
}

}  // namespace
}  // namespace plotscan::scan
