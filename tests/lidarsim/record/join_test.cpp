// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "lidar/fly.h"
#include "lidarsim/lidar/small_farm.h"
#include "record/join_scans.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

namespace fs = std::filesystem;
using lidar::FlyOptions;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

class Join : public ::testing::Test {
 protected:
  // Half a second of flight over the small farm's plots, from a part of the flight to a folder.
  fs::path fly_part(const std::string& name, lidar::FlightPart part, FlyOptions options = {}) {
    options.flight = folder_.write("flight.tum", "100 -3 0 5 0 0 0 1\n100.5 0 0 5 0 0 0 1\n");
    options.part = part;
    lidar::fly(plotscan::testing::small_farm(), folder_.path() / name, options);
    return folder_.path() / name;
  }

  std::vector<fs::path> fly_parts(int of, const FlyOptions& options = {}) {
    std::vector<fs::path> parts;
    for (int number = of; number >= 1; --number)  // any order will do
      parts.push_back(fly_part("part-" + std::to_string(number), {number, of}, options));
    return parts;
  }

  std::string refusal(const std::vector<fs::path>& parts, const JoinOptions& options = {}) {
    return message_of<InputError>([&] { join_scans(parts, folder_.path() / "joined", options); });
  }

  TemporaryFolder folder_;
};

void expect_same_folders(const fs::path& one, const fs::path& other) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(one)) {
    const fs::path file = fs::relative(entry.path(), one);
    EXPECT_TRUE(read_text(one / file) == read_text(other / file)) << file;
    ++files;
  }
  const auto others = fs::recursive_directory_iterator(other);
  EXPECT_EQ(std::distance(begin(others), end(others)), static_cast<std::ptrdiff_t>(files));
}

TEST_F(Join, GivesTheBytesOfTheWholeFlight) {
#ifdef PLOTSCAN_HAVE_PCAP
  const std::vector<std::string> formats = {"las", "pcap", "bag"};
#else
  const std::vector<std::string> formats = {"las", "bag"};
#endif
  const fs::path whole = fly_part("whole", {}, {.formats = formats});
  const JoinSummary summary =
      join_scans(fly_parts(3), folder_.path() / "joined", {.formats = formats});
  EXPECT_EQ(summary.parts, 3U);
  EXPECT_EQ(summary.points, read_manifest(whole)["results"]["points"]);
  EXPECT_GT(summary.points, 20'000U);
  expect_same_folders(whole, folder_.path() / "joined");
}

// Sub-rays come in batches of fewer sequences, plants sway with the time of the whole flight, and
// points are placed by poses that are not the true ones.
TEST_F(Join, GivesTheSameForBeamsSwayAndPoseErrors) {
  FlyOptions options{.sub_rays = 7, .returns = "dual", .pose_error = "gps"};
  options.wind = {.mean_m_s = 4};
  options.threads = 2;
  const fs::path whole = fly_part("whole", {}, options);
  join_scans(fly_parts(2, options), folder_.path() / "joined", {});
  expect_same_folders(whole, folder_.path() / "joined");
}

// As a script for any number of machines may ask for.
TEST_F(Join, OnePartIsTheWholeFlight) {
  const fs::path whole = fly_part("whole", {});
  join_scans({fly_part("part", {1, 1}, {.formats = {"las"}})}, folder_.path() / "joined", {});
  expect_same_folders(whole, folder_.path() / "joined");
}

// More parts than batches: most have no shots.
TEST_F(Join, PartsMayBeEmpty) {
  const auto tum = folder_.write("short.tum", "0 -3 0 5 0 0 0 1\n0.005 0 0 5 0 0 0 1\n");
  const farm::Farm farm = plotscan::testing::small_farm();
  lidar::fly(farm, folder_.path() / "whole", {.flight = tum});
  std::vector<fs::path> parts;
  for (int number = 1; number <= 5; ++number) {
    parts.push_back(folder_.path() / std::to_string(number));
    lidar::fly(farm, parts.back(), {.flight = tum, .part = {number, 5}});
  }
  EXPECT_EQ(read_manifest(parts.front())["results"]["shots"], 0);
  join_scans(parts, folder_.path() / "joined", {});
  expect_same_folders(folder_.path() / "whole", folder_.path() / "joined");
}

TEST_F(Join, PartsThatAreNotTheWholeOfOneFlightAreRefused) {
  std::vector<fs::path> parts = fly_parts(2);
  EXPECT_THAT(refusal({parts[0]}), HasSubstr("part 1/2 of the flight is missing"));
  EXPECT_THAT(refusal({parts[1]}), HasSubstr("part 2/2 of the flight is missing"));
  EXPECT_THAT(refusal({parts[0], parts[0]}), HasSubstr("is part 2/2, as is"));
  EXPECT_THAT(refusal({parts[0], fly_part("third", {1, 3})}),
              HasSubstr("the numbers of parts differ"));
  EXPECT_THAT(refusal({parts[0], fly_part("seed", {1, 2}, {.seed = 2})}),
              HasSubstr("the seeds differ"));
  EXPECT_THAT(refusal({parts[0], fly_part("noise", {1, 2}, {.range_noise_m = 0.02})}),
              HasSubstr("the options differ"));
  EXPECT_THAT(refusal({parts[0], fly_part("whole", {})}), HasSubstr("is no part of a flight"));
  EXPECT_THAT(refusal(parts, {.formats = {"doc"}}), HasSubstr("--format \"doc\""));
  std::ofstream(parts[1] / "cloud.pcd", std::ios::app) << "x";
  EXPECT_THAT(refusal(parts), HasSubstr("was changed after"));
  EXPECT_FALSE(fs::exists(folder_.path() / "joined"));
  EXPECT_THAT(message_of<InputError>([&] {
                fly_part("las", {1, 2}, {.formats = {"las"}});
              }),
              HasSubstr("--format is not for a part"));
}

TEST(FlightPart, IsReadAndCutsAtWholeSteps) {
  const lidar::FlightPart part = lidar::flight_part("2/4");
  EXPECT_EQ(part.number, 2);
  EXPECT_EQ(part.of, 4);
  for (const char* text : {"", "2", "0/4", "5/4", "-1/4", "2/", "/4", "2/4x", "2 /4", "1/10001"})
    EXPECT_THAT(message_of<InputError>([&] { lidar::flight_part(text); }),
                HasSubstr("must be I/N"));
  for (const std::uint64_t sequences : {0, 1, 63, 64, 65, 1000, 6401}) {
    std::uint64_t next = 0;
    for (int number = 1; number <= 7; ++number) {
      const auto [begin, end] = lidar::sequences_of({number, 7}, sequences, 64);
      EXPECT_EQ(begin, next);
      EXPECT_TRUE(begin % 64 == 0 || begin == sequences);
      EXPECT_NEAR(static_cast<double>(end - begin), static_cast<double>(sequences) / 7, 64);
      next = end;
    }
    EXPECT_EQ(next, sequences);
  }
}

}  // namespace
}  // namespace plotscan::record
