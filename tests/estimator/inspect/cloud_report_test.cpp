// SPDX-License-Identifier: Apache-2.0
#include "inspect/cloud_report.h"

#include <cmath>
#include <cstring>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::inspect {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

// A grid of points over 40 m x 20 m, `a_side` times `a_side` a square metre.
std::string field(int a_side, double unit_m = 1) {
  std::string text = "x y z\n";
  for (int i = 0; i < 40 * a_side; ++i) {
    for (int j = 0; j < 20 * a_side; ++j) {
      text += format_number((i + 0.5) / a_side / unit_m) + " " +
              format_number((j + 0.5) / a_side / unit_m) + " 5\n";
    }
  }
  return text;
}

TEST(CloudReport, CountsTheDensityOfTheField) {
  const TemporaryFolder folder;
  for (const int a_side : {1, 3, 12}) {
    const CloudReport report = inspect_cloud(folder.write("field.xyz", field(a_side)));
    EXPECT_EQ(report.facts.format, "text");
    EXPECT_EQ(report.facts.points, 800u * a_side * a_side);
    EXPECT_NEAR(report.density.median, a_side * a_side, 1e-9) << a_side;
    EXPECT_NEAR(report.density.least5, a_side * a_side, 1e-9) << a_side;
    EXPECT_NEAR(report.density.area_m2, (40 - 1.0 / a_side) * (20 - 1.0 / a_side), 1e-9);
  }
}

TEST(CloudReport, SaysWhetherPlotsCanBeFound) {
  const TemporaryFolder folder;
  EXPECT_THAT(inspect_cloud(folder.write("thin.xyz", field(3))).obstacles,
              ElementsAre(HasSubstr("9 points/m2 are too few")));
  const CloudReport between = inspect_cloud(folder.write("between.xyz", field(8)));
  EXPECT_THAT(between.obstacles, IsEmpty());
  EXPECT_THAT(between.doubts, ElementsAre(HasSubstr("64 points/m2 may be too few")));
  const CloudReport dense = inspect_cloud(folder.write("dense.xyz", field(12)));
  EXPECT_THAT(dense.obstacles, IsEmpty());
  EXPECT_THAT(dense.doubts, IsEmpty());
  EXPECT_EQ(to_json(dense)["can_carry_plots"], true);
}

TEST(CloudReport, OnePlaceCarriesNoPlots) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 500; ++i) text += "3 4 5\n3.05 4.05 6\n";
  EXPECT_THAT(inspect_cloud(folder.write("place.xyz", text)).obstacles,
              ElementsAre(HasSubstr("within 10 cm of one place")));
}

TEST(CloudReport, TheFieldIsNoLargerThanTheCloud) {
  const TemporaryFolder folder;
  const cloud::FieldDensity point = inspect_cloud(folder.write("point.xyz", "3 4 5\n")).density;
  EXPECT_THAT(point.field, ElementsAre(3, 4, 3, 4));
  EXPECT_EQ(point.area_m2, 0);
  EXPECT_GT(point.median, 0);
  EXPECT_THAT(inspect_cloud(folder.write("two.xyz", "3 4 5\n10 8 5\n")).density.field,
              ElementsAre(3, 4, 10, 8));
}

// Geocentric coordinates: z is thousands of kilometres. `estimator run` refuses them as well.
TEST(CloudReport, RefusesPointsBeyondAnyHeight) {
  const TemporaryFolder folder;
  const auto file = folder.write("geocentric.xyz", "-300000 -4800000 4200000\n");
  EXPECT_THAT(message_of<InputError>([&] { inspect_cloud(file); }),
              HasSubstr("geocentric.xyz: its points lie beyond any place on Earth"));
}

// Northings in UTM as floats of 4 bytes, 0.5 m apart; a raster with a point at each of its steps.
TEST(CloudReport, DoubtsCoordinatesThatLostTheirDigits) {
  const TemporaryFolder folder;
  std::string floats;
  std::string raster;
  for (int i = 0; i < 40000; ++i) {
    floats += fmt::format("{:.3f} {:.1f} 5\n", 500000 + 0.0131 * (i % 1500),
                          std::round((4600000 + i / 2000.0) * 2) / 2);
    raster += fmt::format("{:.2f} {:.2f} 5\n", 0.1 * (i % 200), 0.1 * (i / 200));
  }
  EXPECT_THAT(inspect_cloud(folder.write("floats.xyz", floats)).doubts,
              ElementsAre(HasSubstr("y counts in steps of 0.5 m")));
  EXPECT_THAT(inspect_cloud(folder.write("raster.xyz", raster)).doubts, IsEmpty());
}

// Two points at the ends of the world, and a field of 9 km2.
TEST(CloudReport, ThinCloudsHaveADensity) {
  const TemporaryFolder folder;
  const CloudReport two = inspect_cloud(folder.write("two.xyz", "0 0 0\n2e9 2e9 0\n"));
  EXPECT_LT(two.density.median, 0.1);
  EXPECT_EQ(two.obstacles.size(), 1u);
  std::string text;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y)
      text += std::to_string(30 * x) + " " + std::to_string(30 * y) + " 0\n";
  EXPECT_NEAR(inspect_cloud(folder.write("wide.xyz", text)).density.median, 1 / 900.0, 2e-4);
}

// Density is of square metres, the extent is the file's.
TEST(CloudReport, KnowsUnits) {
  const TemporaryFolder folder;
  const auto file = folder.write("feet.xyz", field(3, 0.3048));
  CloudFiles cloud(file);
  cloud.units = {0.3048, 0.3048};
  const CloudReport report = inspect_cloud(cloud);
  EXPECT_NEAR(report.density.median, 9, 1e-9);
  EXPECT_NEAR(report.facts.bounds.max().x(), (40 - 0.5 / 3) / 0.3048, 1e-9);
  EXPECT_NEAR(report.facts.bounds_m.max().x(), 40 - 0.5 / 3, 1e-9);
  EXPECT_NEAR(to_json(report)["units_m"]["x_y"], 0.3048, 1e-12);
}

// LAS 1.2, point format 1, after the tables of the specification.
std::string las(int points) {
  std::string bytes(227, '\0');
  const auto put = [](std::string& to, std::size_t offset, auto value) {
    std::memcpy(&to[offset], &value, sizeof value);
  };
  std::memcpy(bytes.data(), "LASF", 4);
  put(bytes, 6, std::uint16_t{1});  // adjusted standard GPS time
  put(bytes, 24, std::uint8_t{1});
  put(bytes, 25, std::uint8_t{2});
  put(bytes, 94, std::uint16_t{227});
  put(bytes, 96, std::uint32_t{227});
  put(bytes, 104, std::uint8_t{1});
  put(bytes, 105, std::uint16_t{28});
  put(bytes, 107, static_cast<std::uint32_t>(points));
  for (const std::size_t axis : {0, 1, 2}) put(bytes, 131 + 8 * axis, 1.0);
  for (int i = 0; i < points; ++i) {
    std::string point(28, '\0');
    put(point, 0, std::int32_t{i % 10});
    put(point, 4, std::int32_t{i / 10});
    point[14] = static_cast<char>(i % 4 == 0 ? 0x12 : 0x11);  // of two returns, the second or first
    point[15] = static_cast<char>(i == 0 ? 0x87 : 2);         // withheld low noise; ground
    // 2019-01-01T00:00:00Z is 1,230,336,018 s of GPS time: 14,240 days from its epoch and 18 s.
    put(point, 20, 230336018.0 + i);
    bytes += point;
  }
  return bytes;
}

TEST(CloudReport, TellsReturnsClassesAndTime) {
  const TemporaryFolder folder;
  const CloudReport report = inspect_cloud(folder.write("a.las", las(100)));
  const nlohmann::json document = to_json(report);
  EXPECT_EQ(document["format"], "LAS 1.2, point format 1");
  EXPECT_EQ(document["returns"], (nlohmann::json{{"1", 75}, {"2", 25}}));
  EXPECT_EQ(document["classes"], (nlohmann::json{{"2", 99}, {"7", 1}}));
  EXPECT_EQ(document["marked"], 1);
  EXPECT_EQ(document["time"]["first_utc"], "2019-01-01T00:00:00Z");
  EXPECT_EQ(document["time"]["last_utc"], "2019-01-01T00:01:39Z");
  EXPECT_THAT(
      report.obstacles,
      ElementsAre(
          HasSubstr("are too few"),
          "every point but noise is of the class ground: there is no crop, or it was taken out"));
  EXPECT_THAT(report.facts.fields,
              ElementsAre("x", "y", "z", "intensity", "return_number", "number_of_returns",
                          "classification", "withheld", "gps_time"));
}

// Surveys of others: what is known of them.
TEST(CloudReport, KnowsCloudsOfOthers) {
  const std::filesystem::path real = PLOTSCAN_SHARED_DATA_DIR "/real";
  if (!exists(real)) GTEST_SKIP() << real << " is not at hand";
  const CloudReport iowa = inspect_cloud(real / "iowa_farmland_80m.las");
  EXPECT_EQ(iowa.facts.points, 4046u);
  EXPECT_EQ(iowa.facts.system.crs, "EPSG:26915");
  EXPECT_NEAR(iowa.density.median, 0.7, 0.15);  // 4,046 points over 80 m x 80 m, strips overlap
  EXPECT_THAT(iowa.obstacles,
              ElementsAre(HasSubstr("points/m2 are too few"),
                          HasSubstr("class ground: there is no crop, or it was taken out")));
  const CloudReport nebraska = inspect_cloud(real / "nebraska_us_feet.las");
  EXPECT_NEAR(nebraska.facts.bounds.min().x(), 2445180, 1e-3);
  EXPECT_NEAR(nebraska.facts.system.units.horizontal_m, 1200.0 / 3937, 1e-15);
  EXPECT_NEAR(inspect_cloud(real / "csf_sample.ply").density.median, 1.9, 0.6);
  const CloudReport town = inspect_cloud(real / "autzen-utm.pcd");  // 1,065 points over 139 ha
  EXPECT_NEAR(town.density.median, 1065 / 1.39e6, 5e-4);
}

}  // namespace
}  // namespace plotscan::inspect
