// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/random.h"
#include "foundation/report/unpack.h"
#include "report/internal/pack_cloud.h"
#include "report/internal/packed.h"
#include "report/shown_cloud.h"
#include "report/shown_field.h"

namespace plotscan::report {
namespace {

using ::testing::HasSubstr;
using testing::Point;

// Points anywhere in 40 x 30 x 2 m, each with fields that tell which one it is.
ShownCloud random_cloud(std::size_t count) {
  ShownCloud cloud{.origin = {1000, 2000, 0},
                   .read = count,
                   .has_class = true,
                   .has_plot = true,
                   .has_intensity = true,
                   .has_time = true};
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(1, random_purpose("test/report"), i);
    const auto coordinate = [&](double size) {
      return static_cast<float>(random.uniform(0, size));
    };
    cloud.points.push_back({.place = {coordinate(40) - 20, coordinate(30) - 15, coordinate(2)},
                            .intensity = static_cast<float>(i % 256),
                            .time_s = static_cast<float>(i) / static_cast<float>(count - 1),
                            .plot = static_cast<std::uint32_t>(i),
                            .label = static_cast<std::uint8_t>(i % 5)});
  }
  return cloud;
}

TEST(PackedCloud, EveryPointComesBackOnceWithItsFields) {
  const ShownCloud cloud = random_cloud(60'000);
  const nlohmann::json packed = packed_cloud(cloud);
  std::set<int> seen;
  for (const auto& tile : packed["tiles"]) {
    EXPECT_LE(tile["n"], 32'768);
    EXPECT_EQ(tile["at"].get<std::size_t>() % 3, 0U);
    for (const Point& point : testing::tile_points(packed, tile)) {
      ASSERT_TRUE(seen.insert(point.plot).second);
      const ShownPoint& original = cloud.points.at(point.plot);
      // Half a step, and the rounding of the tile's corner.
      EXPECT_NEAR(point.x, original.place.x(), kStep_m / 2 + 1e-4);
      EXPECT_NEAR(point.y, original.place.y(), kStep_m / 2 + 1e-4);
      EXPECT_NEAR(point.z, original.place.z(), kStep_m / 2 + 1e-4);
      EXPECT_EQ(point.label, original.label);
      EXPECT_EQ(point.intensity, point.plot % 256);
      EXPECT_NEAR(point.time, 255 * original.time_s, 0.51);
    }
  }
  EXPECT_EQ(seen.size(), cloud.points.size());
  EXPECT_EQ(packed["shown"], cloud.points.size());
}

std::array<int, 9> counts_by_ninth(std::span<const Point> points) {
  std::array<int, 9> counts{};
  for (const Point& point : points) {
    const int row = static_cast<int>((point.y + 15) / 10.01);
    ++counts.at(3 * row + static_cast<int>((point.x + 20) / 13.35));
  }
  return counts;
}

// The beginning that a level shows has as large a share of each ninth of the tile, far closer than
// points drawn at random.
TEST(PackedCloud, ABeginningOfATileIsAnEvenSampleOfIt) {
  const nlohmann::json packed = packed_cloud(random_cloud(32'000));
  ASSERT_EQ(packed["tiles"].size(), 1U);
  const std::vector<Point> points = testing::tile_points(packed, packed["tiles"][0]);
  const auto all = counts_by_ninth(points);
  const int levels = tile_levels(points.size());
  EXPECT_EQ(levels, 7);
  for (int level = 0; level < levels; ++level) {
    const int stride = 1 << (levels - level);
    const std::size_t shown = (points.size() + stride - 1) / stride;
    const auto some = counts_by_ninth(std::span(points).first(shown));
    for (std::size_t i = 0; i < 9; ++i) {
      const double expected = static_cast<double>(all.at(i)) / stride;
      EXPECT_NEAR(some.at(i), expected, 0.6 * std::sqrt(expected) + 2) << "level " << level;
    }
  }
}

TEST(PackedCloud, StretchesItsStepsOverTallTiles) {
  ShownCloud cloud{.points = {{.place = {0, 0, 0}}, {.place = {0, 0, 1000}}}, .read = 2};
  const nlohmann::json packed = packed_cloud(cloud);
  const auto points = testing::tile_points(packed, packed["tiles"][0]);
  EXPECT_GT(packed["tiles"][0]["step"], kStep_m);
  EXPECT_NEAR(std::max(points[0].z, points[1].z), 1000, 0.02);
}

TEST(PackedCloud, OfNoPointsHasNoTiles) { EXPECT_TRUE(packed_cloud({})["tiles"].empty()); }

TEST(PackedNumbers, ComeBackWithinHalfAStep) {
  std::vector<float> numbers = {-1.5F, 0, 2.25F, std::numeric_limits<float>::quiet_NaN(), 130.F};
  const nlohmann::json packed = packed_numbers(numbers, 0.001);
  const auto& data = packed["data"].get_binary();
  const auto whole = testing::numbers(testing::inflated(data.data(), data.size(), 10), 0, 5);
  const double step = packed["step"];
  EXPECT_NEAR(step, 0.004, 1e-12);  // 131.5 m do not fit in 65534 mm
  for (const std::size_t i : {0, 1, 2, 4})
    EXPECT_NEAR(packed["low"].get<double>() + step * whole[i], numbers[i], step / 2 + 1e-6);
  EXPECT_EQ(whole[3], 65535);
}

TEST(CloudSample, KeepsAllWhereThereIsRoomAndAFairShareElse) {
  CloudSample all(10);
  for (int i = 0; i < 10; ++i) all.add({.plot = static_cast<std::uint32_t>(i)});
  EXPECT_EQ(all.take().size(), 10U);
  CloudSample some(1000);
  for (int i = 0; i < 100'000; ++i) some.add({.plot = static_cast<std::uint32_t>(i)});
  EXPECT_EQ(some.read(), 100'000U);
  const auto kept = some.take();
  ASSERT_EQ(kept.size(), 1000U);
  std::array<int, 10> counts{};
  for (const ShownPoint& point : kept) ++counts.at(point.plot / 10'000);
  // Binomial, 100 expected of each tenth: 5 standard deviations.
  for (const int count : counts) EXPECT_NEAR(count, 100, 48);
}

TEST(CloudSample, RefusesWhatAPageCannotShow) {
  EXPECT_THROW(CloudSample(0), InputError);
  EXPECT_THROW(CloudSample(kMostPoints + 1), InputError);
}

TEST(PackedField, SaysWhatIsKnownAndNullWhatIsNot) {
  ShownField field{.name = "f"};
  field.plots.push_back({.id = "7",
                         .box = {.center = {1, 2}, .width_m = 1.5, .length_m = 4, .heading_rad = 1},
                         .heights = {{"max", {0.91234567, 0.02, 0.87, std::nan("")}}},
                         .state = PlotState::extra});
  const nlohmann::json packed = packed_field(field);
  const nlohmann::json& plot = packed["plots"][0];
  EXPECT_EQ(plot["heights"]["max"], nlohmann::json({0.91235, 0.02, 0.87, nullptr}));
  EXPECT_EQ(plot["box"], nlohmann::json({1.0, 2.0, 1.5, 4.0, 57.29578}));
  EXPECT_EQ(plot["state"], "extra");
  EXPECT_FALSE(plot.contains("confidence"));
  EXPECT_FALSE(packed.contains("cloud"));
}

}  // namespace
}  // namespace plotscan::report
