// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>

#include "core/error.h"
#include "core/manifest.h"
#include "farmfolder/write_farm.h"
#include "lidar/fly_place.h"
#include "record/convert.h"
#include "scan/trajectory.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

// A second of flight over the small farm's plots.
std::filesystem::path short_flight(const TemporaryFolder& folder) {
  return folder.write("flight.tum", "100 -3 0 5 0 0 0 1\n101 3 0 5 0 0 0 1\n");
}

TEST(Fly, WritesAScanFolder) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto scan = folder.path() / "scan";
  double last_share = 0;
  const FlySummary summary =
      fly(farm, scan, {.flight = short_flight(folder), .seed = 4}, [&](double share) {
        EXPECT_GE(share, last_share);
        last_share = share;
      });
  EXPECT_DOUBLE_EQ(summary.duration_s, 1);
  EXPECT_EQ(summary.shots, 18084u * 16);
  EXPECT_DOUBLE_EQ(last_share, 1);

  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read((scan / "cloud.pcd").string(), cloud), 0);
  EXPECT_EQ(cloud.width, summary.points);
  EXPECT_GT(summary.points, 50000u);

  const scan::Trajectory flown = scan::read_trajectory(scan / "trajectory.csv");
  EXPECT_EQ(flown.start_s(), 0);  // seconds from take-off
  EXPECT_EQ(flown.world_from_body(0.5).translation(), Eigen::Vector3d(0, 0, 5));

  const nlohmann::json manifest = read_manifest(scan);
  EXPECT_EQ(manifest["seed"], 4);
  EXPECT_EQ(manifest["results"]["points"], summary.points);
  EXPECT_EQ(manifest["options"]["mount_rpy_deg"], (nlohmann::json{0, 90, 0}));
}

TEST(Fly, SameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto bytes = [&](int threads, const std::string& file) {
    const auto scan = folder.path() / std::to_string(threads);
    if (!exists(scan)) fly(farm, scan, {.flight = short_flight(folder), .threads = threads});
    return read_text(scan / file);
  };
  for (const std::string file : {"cloud.pcd", "trajectory.csv", "manifest.json"}) {
    const std::string one = bytes(1, file);
    EXPECT_TRUE(one == bytes(2, file)) << file;
    EXPECT_TRUE(one == bytes(7, file)) << file;
  }
}

// The scan's own trajectory flies the same scan again.
TEST(Fly, PlannedFlightRepeatsFromItsTrajectory) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto planned = folder.path() / "planned";
  const FlySummary summary = fly(farm, planned, {.altitude_m = 5, .speed_m_s = 4, .spacing_m = 2});
  EXPECT_GT(summary.duration_s, 5);
  const auto repeated = folder.path() / "repeated";
  fly(farm, repeated, {.flight = planned / "trajectory.csv"});
  EXPECT_TRUE(read_text(planned / "cloud.pcd") == read_text(repeated / "cloud.pcd"));
}

TEST(Fly, SpinIsTheSensorsOwnUnlessAskedFor) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto options_of = [&](const char* name, const FlyOptions& options) {
    fly(farm, folder.path() / name, options);
    return read_manifest(folder.path() / name)["options"];
  };
  EXPECT_EQ(options_of("own", {.speed_m_s = 4})["spin_hz"], 10.0);
  EXPECT_EQ(options_of("asked", {.speed_m_s = 4, .spin_hz = 10})["spin_hz"], 10.0);
  EXPECT_EQ(options_of("faster", {.speed_m_s = 4, .spin_hz = 15})["spin_hz"], 15.0);
  const auto cloud = [&](const char* name) {
    return read_text(folder.path() / name / "cloud.pcd");
  };
  EXPECT_TRUE(cloud("own") == cloud("asked"));
  EXPECT_FALSE(cloud("own") == cloud("faster"));
}

TEST(Fly, WindMovesThePlannedFlightAndNoOther) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto trajectory = [&](const std::string& name, FlyOptions options) {
    options.altitude_m = 5;
    options.speed_m_s = 3;
    options.pattern = "single";
    const auto scan = folder.path() / name;
    fly(farm, scan, options);
    return read_text(scan / "trajectory.csv");
  };
  const std::string still = trajectory("still", {});
  EXPECT_EQ(trajectory("plants", {.wind = {.mean_m_s = 3}, .wind_acts_on = "plants"}), still);
  EXPECT_EQ(trajectory("calm", {.wind = {.from_deg = 90, .turbulence = 1}}), still);
  const std::string windy = trajectory("windy", {.wind = {.mean_m_s = 3}});
  EXPECT_NE(windy, still);
  EXPECT_EQ(trajectory("again", {.wind = {.mean_m_s = 3}, .threads = 3}), windy);
  const FlyOptions given{.flight = folder.path() / "still" / "trajectory.csv",
                         .wind = {.mean_m_s = 3}};
  EXPECT_EQ(trajectory("given", given), still);
}

TEST(Fly, FliesWaypoints) {
  const TemporaryFolder folder;
  const auto file = folder.write("way.yaml",
                                 "waypoints:\n  - {x_m: -3, y_m: 0, z_m: 5}\n"
                                 "  - {x_m: 3, y_m: 0, z_m: 7, hold_s: 1}\n");
  const auto scan = folder.path() / "scan";
  fly(testing::small_farm(), scan, {.waypoints = file});
  const scan::Trajectory flown = scan::read_trajectory(scan / "trajectory.csv");
  EXPECT_NEAR(
      (flown.world_from_body(flown.end_s()).translation() - Eigen::Vector3d(3, 0, 7)).norm(), 0,
      1e-9);
  const nlohmann::json manifest = read_manifest(scan);
  EXPECT_EQ(manifest["options"]["waypoints"], "way.yaml");
  EXPECT_FALSE(manifest["options"].contains("pattern"));
}

TEST(Fly, ImpossibleOptionsAreRefusedAndLeaveNothing) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto scan = folder.path() / "out" / "scan";
  const auto refusal = [&](const FlyOptions& options) {
    return message_of<InputError>([&] { fly(farm, scan, options); });
  };
  EXPECT_THAT(refusal({.sensor = "os1"}), HasSubstr("\"os1\" is unknown; there are vlp16"));
  EXPECT_THAT(refusal({.spin_hz = 4.9}), HasSubstr("--spin 4.9 must be in [5, 20] Hz"));
  EXPECT_THAT(refusal({.spin_hz = 20.5}), HasSubstr("--spin 20.5 must be in [5, 20] Hz for"));
  EXPECT_THAT(refusal({.spin_hz = std::nan("")}), HasSubstr("--spin nan must be in"));
  EXPECT_THAT(refusal({.range_noise_m = -0.1}), HasSubstr("--noise -0.1 must be in [0, 1]"));
  EXPECT_THAT(refusal({.start_utc = "noon"}), HasSubstr("--start \"noon\" must be like 2026-"));
  EXPECT_THAT(refusal({.mount_rpy_deg = {0, INFINITY, 0}}), HasSubstr("--mount inf must be in"));
  EXPECT_THAT(refusal({.threads = 0}), HasSubstr("threads 0"));
  EXPECT_THAT(refusal({.speed_m_s = 50}), HasSubstr("--speed 50 must be in [0.01, 6]"));
  EXPECT_THAT(refusal({.pattern = "spiral"}), HasSubstr("must be one of lawnmower, crosshatch"));
  EXPECT_THAT(refusal({.heading_deg = 400}), HasSubstr("--heading 400 must be in [-360, 360]"));
  EXPECT_THAT(refusal({.wind = {.mean_m_s = 6}}),
              HasSubstr("the drone holds 4.09 m/s at most; fly slower"));
  EXPECT_THAT(refusal({.wind = {.mean_m_s = -1}}), HasSubstr("--wind -1 must be in [0, 30]"));
  EXPECT_THAT(refusal({.wind_acts_on = "birds"}), HasSubstr("--wind-acts-on"));
  EXPECT_THAT(refusal({.altitude_m = -1}), HasSubstr("--altitude -1 must be in"));
  EXPECT_THAT(refusal({.flight = folder.path() / "none"}), HasSubstr("no such file"));
  EXPECT_THAT(refusal({.flight = folder.write("long", "0 0 0 5 0 0 0 1\n1e9 0 0 5 0 0 0 1\n")}),
              HasSubstr("at most 86400 s"));
  EXPECT_TRUE(!exists(folder.path() / "out") || is_empty(folder.path() / "out"));
}

#ifdef PLOTSCAN_HAVE_PCAP
const std::vector<std::string> kFormats = {"pcd", "ply", "las", "pcap", "bag", "mcap"};
#else
const std::vector<std::string> kFormats = {"pcd", "ply", "las", "bag", "mcap"};
#endif

TEST(Fly, FormatsBesideTheCloudAreWhatConvertMakes) {
  const TemporaryFolder folder;
  const auto way = short_flight(folder);
  farm::Farm farm = testing::small_farm();
  farm.anchor = Anchor{.latitude_deg = 37.2, .longitude_deg = -80.5, .altitude_m = 610};
  const auto plain = folder.path() / "plain";
  const auto scan = folder.path() / "scan";
  fly(farm, plain, {.flight = way});
  fly(farm, scan, {.flight = way, .formats = kFormats});
  const nlohmann::json manifest = read_manifest(scan);
  EXPECT_EQ(manifest["options"]["formats"], kFormats);
  for (const std::string& format : kFormats) {
    const bool is_cloud = format == "pcd" || format == "ply" || format == "las";
    const std::string name = (is_cloud ? "cloud." : "flight.") + format;
    record::convert(plain, folder.path() / name, {});
    EXPECT_EQ(file_hash(scan / name), file_hash(folder.path() / name)) << name;
    EXPECT_NO_THROW(require_unchanged(scan, name));
    EXPECT_THAT(manifest["outputs"].dump(), HasSubstr(name));
  }
  const auto files = [](const auto& path) {
    return std::distance(std::filesystem::directory_iterator(path), {});
  };
  EXPECT_EQ(files(scan), files(plain) + static_cast<std::ptrdiff_t>(kFormats.size()) - 1);
}

TEST(Fly, FormatsThatCannotBeAreRefusedBeforeTheFlight) {
  const TemporaryFolder folder;
  const auto scan = folder.path() / "scan";
  const auto refusal = [&](FlyOptions options) {
    options.flight = folder.path() / "absent";  // would be refused next
    return message_of<InputError>([&] { fly(testing::small_farm(), scan, options); });
  };
  EXPECT_THAT(refusal({.formats = {"las", "xyz"}}),
              HasSubstr("--format \"xyz\" must be one of pcd, ply, las"));
  EXPECT_THAT(refusal({.formats = {"LAS"}}), HasSubstr("must be one of"));
  EXPECT_THAT(refusal({.formats = {""}}), HasSubstr("must be one of"));
#ifdef PLOTSCAN_HAVE_PCAP
  EXPECT_THAT(refusal({.sensor = "os1_64", .formats = {"pcap"}}),
              HasSubstr("os1_64 sends no Velodyne packets"));
#endif
  EXPECT_FALSE(exists(scan));
}

TEST(Fly, ReplacesOnlyWhenAskedTo) {
  const TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto scan = folder.path() / "scan";
  FlyOptions options{.flight = short_flight(folder)};
  fly(farm, scan, options);
  EXPECT_THAT(message_of<InputError>([&] { fly(farm, scan, options); }), HasSubstr("--force"));
  options.replace = true;
  EXPECT_NO_THROW(fly(farm, scan, options));
}

std::string flown_cloud(const TemporaryFolder& folder, FlyOptions options) {
  const auto scan = folder.path() / "scan";
  options.replace = true;
  fly(testing::small_farm(), scan, options);
  return read_text(scan / "cloud.pcd");
}

// The crop of a swaying farm comes back to rest with wind 0.
TEST(Fly, CropIsAtRestWithoutWind) {
  const TemporaryFolder folder;
  FlyOptions options{.flight = short_flight(folder), .wind_acts_on = "drone"};
  const std::string rest = flown_cloud(folder, options);
  options.wind_acts_on = "plants";
  EXPECT_TRUE(flown_cloud(folder, options) == rest);
  options.wind.mean_m_s = 8;
  EXPECT_FALSE(flown_cloud(folder, options) == rest);
  options.wind.mean_m_s = 0;
  EXPECT_TRUE(flown_cloud(folder, options) == rest);
}

std::filesystem::path written_farm(const TemporaryFolder& folder) {
  farm::Farm farm = testing::small_farm();
  for (std::size_t i = 0; i < farm.plants.size(); ++i)
    farm.plants[i].id = static_cast<std::uint32_t>(i + 1);  // as a farm's folder has them
  farmfolder::write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
  return folder.path() / "farm";
}

TEST(FlyPlace, AWindThatMovesNothingIsRefused) {
  const TemporaryFolder folder;
  const auto place = written_farm(folder);
  FlyPlaceOptions options{.flight = {.flight = short_flight(folder), .wind_acts_on = "drone"}};
  options.flight.wind.mean_m_s = 3;
  const auto fly_here = [&] { fly_place(place, folder.path() / "scan", options); };
  EXPECT_THAT(message_of<InputError>(fly_here),
              HasSubstr("--wind 3 moves nothing here: a trajectory (--flight) is flown as it is, "
                        "and --wind-acts-on drone leaves the plants at rest"));
  options.flight.wind_acts_on = "both";
  EXPECT_NO_THROW(fly_here());
  options.flight.wind_acts_on = "plants";
  const auto world = folder.write("world.sdf", "<sdf version='1.9'/>");
  EXPECT_THAT(message_of<InputError>([&] { fly_place(world, folder.path() / "scan", options); }),
              HasSubstr("no plants sway"));
  options.flight.sway.lean_deg_at_5m_s = 0;
  EXPECT_THAT(message_of<InputError>([&] { fly_place(place, folder.path() / "still", options); }),
              HasSubstr("no plants sway"));
}

TEST(FlyPlace, AnEmptyScanSaysWhy) {
  const TemporaryFolder folder;
  const auto place = written_farm(folder);
  FlyPlaceOptions options{.flight = {.flight = short_flight(folder), .replace = true}};
  const auto notes = [&] { return fly_place(place, folder.path() / "scan", options).notes; };
  EXPECT_THAT(notes(), IsEmpty());
  options.flight.flight = folder.write("far.tum", "0 9000 0 5 0 0 0 1\n1 9003 0 5 0 0 0 1\n");
  EXPECT_THAT(
      notes(),
      ElementsAre("the scan is empty: nothing lies within 0.4 to 100 m, the range of vlp16; "
                  "is the flight over the field, and low enough?"));
  options.flight.flight.reset();
  options.flight.speed_m_s = 6;
  options.flight.altitude_m = 120;
  EXPECT_THAT(notes(), ElementsAre(HasSubstr("--altitude 120 is too high")));
}

TEST(FlyPlace, AFlightBelowTheGroundIsNoted) {
  const TemporaryFolder folder;
  const auto place = written_farm(folder);
  FlyPlaceOptions options{
      .flight = {.flight = folder.write("deep.tum",
                                        "0 -1 0 5 0 0 0 1\n1 0 0 -5 0 0 0 1\n"
                                        "2 1 0 -5 0 0 0 1\n3 2 0 -5 0 0 0 1\n")}};
  EXPECT_THAT(fly_place(place, folder.path() / "scan", options).notes,
              Contains(HasSubstr("75.0 % of the flight lies below the ground")));
}

TEST(FlyPlace, AFarmHoldsItsModels) {
  const TemporaryFolder folder;
  FlyPlaceOptions options{.resource_paths = {folder.path()}};
  EXPECT_THAT(
      message_of<InputError>([&] { fly_place(folder.path(), folder.path() / "scan", options); }),
      HasSubstr("--resource-path is for SDF worlds"));
}

TEST(Fly, SwayingCropHasTheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  FlyOptions options{.flight = short_flight(folder)};
  options.wind.mean_m_s = 8;
  const std::string one = flown_cloud(folder, options);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    EXPECT_TRUE(flown_cloud(folder, options) == one) << threads;
  }
}

}  // namespace
}  // namespace plotscan::lidar
