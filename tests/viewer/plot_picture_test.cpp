// SPDX-License-Identifier: Apache-2.0
#include "view/plot_picture.h"

#include <algorithm>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "viewer/pixels.h"
#include "viewer/shown_field.h"

namespace plotscan::view {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

const Eigen::Vector2d kPlotOrigin(552000, 4128000);

// A plot of 4 x 1 m that heads north, on level ground at 300 m.
estimate::Estimate one_plot() {
  estimate::Estimate estimate{.method = "lattice"};
  estimate.ground = plane(kPlotOrigin, 300, {0, 0}, 51);
  estimate.plots.push_back({.id = 7,
                            .row = 2,
                            .column = 3,
                            .box = {.center = kPlotOrigin + Eigen::Vector2d(5, 5),
                                    .width_m = 1,
                                    .length_m = 4,
                                    .heading_rad = std::numbers::pi / 2},
                            .heights_m = {{"mean", 0.5}, {"p95", 0.8}, {"max", 1.0}},
                            .errors = {{"max", {0.02, 0.96, 1.04}}}});
  return estimate;
}

// Ground everywhere, and crop of 0.3 m in the plot's southern half.
std::filesystem::path plot_cloud(const TemporaryFolder& folder) {
  return write_field(folder, kPlotOrigin, kPlotOrigin + Eigen::Vector2d(10, 10), 0.04,
                     [](const Eigen::Vector2d& place) {
                       const Eigen::Vector2d p = place - kPlotOrigin;
                       const bool crop = std::abs(p.x() - 5) < 0.5 && p.y() > 3 && p.y() < 5;
                       return crop ? 300.3 : 300.0;
                     });
}

bool near(const Colour& c, int red, int green, int blue) {
  return std::abs(c[0] - red) < 25 && std::abs(c[1] - green) < 25 && std::abs(c[2] - blue) < 25;
}
bool mean_line(const Colour& c) { return near(c, 213, 94, 0); }
bool max_line(const Colour& c) { return near(c, 0, 114, 178); }
bool ground_line(const Colour& c) { return near(c, 34, 34, 34); }
bool crop_points(const Colour& c) { return c[1] > c[0] + 60 && c[1] > c[2] + 15 && c[0] < 160; }

// Middle of the rows that have the most pixels of the colour within a part of the width.
double row_of(const std::filesystem::path& png, double from, double to,
              const std::function<bool(const Colour&)>& wanted) {
  int width = 0;
  for_pixels(png, [&](int x, int, const Colour&) { width = std::max(width, x + 1); });
  std::map<int, int> counts;
  for_pixels(png, [&](int x, int y, const Colour& colour) {
    if (x >= from * width && x < to * width && wanted(colour)) ++counts[y];
  });
  int most = 0;
  for (const auto& [y, count] : counts) most = std::max(most, count);
  double sum = 0;
  int rows = 0;
  for (const auto& [y, count] : counts) {
    if (count < 0.9 * most) continue;
    sum += y;
    ++rows;
  }
  return sum / rows;
}

TEST(PlotPicture, ShowsHeightsOverTheGround) {
  const TemporaryFolder folder;
  const auto png = folder.path() / "plot.png";
  draw_plot(plot_cloud(folder), one_plot(), 7, png, {.width_px = 1200});
  // Where nothing else lies over them: the northern half.
  const double mean = row_of(png, 0.45, 0.6, mean_line);
  const double max = row_of(png, 0.45, 0.6, max_line);
  // The axis below is of the ground's colour: the ground is sought within the chart.
  const double ground = row_of(png, 0.45, 0.6, [](const Colour& c) { return crop_points(c); });
  ASSERT_GT(max, mean);
  EXPECT_NEAR((mean - ground) / (max - ground), 0.5, 0.02);
}

TEST(PlotPicture, ShowsPointsInThePlotApartFromThoseBeyond) {
  const TemporaryFolder folder;
  const auto png = folder.path() / "plot.png";
  draw_plot(plot_cloud(folder), one_plot(), 7, png, {.width_px = 800});
  int width = 0;
  int first = 1 << 30;
  int last = 0;
  int height = 0;
  for_pixels(png, [&](int x, int y, const Colour&) {
    width = std::max(width, x + 1);
    height = std::max(height, y + 1);
  });
  std::map<int, std::vector<int>> rows;
  for_pixels(png, [&](int x, int y, const Colour& colour) {
    if (y < 0.1 * height || !crop_points(colour)) return;  // the legend is below
    first = std::min(first, x);
    last = std::max(last, x);
    rows[y].push_back(x);
  });
  // The crop of 0.3 m is the southern half: the left one, as the length axis points north.
  const auto crop = rows.rbegin()->second;
  EXPECT_NEAR(crop.front(), first, 8);
  EXPECT_NEAR(crop.back(), (first + last) / 2.0, 0.02 * width);
}

TEST(PlotPicture, DashesTheGroundWhereItIsInterpolated) {
  const TemporaryFolder folder;
  const auto cloud = plot_cloud(folder);
  auto estimate = one_plot();
  const auto inked = [&](const char* name) {
    draw_plot(cloud, estimate, 7, folder.path() / name, {.width_px = 800, .heights = {"mean"}});
    return count_pixels(folder.path() / name, 0.2, 0.7, ground_line);
  };
  const int solid = inked("solid.png");
  std::ranges::fill(estimate.ground->seen, 0);
  const int dashed = inked("dashed.png");
  EXPECT_LT(dashed, solid - 100);  // of some 400 pixels, half are between dashes
}

TEST(PlotPicture, DrawsPlotsWithoutHeightsOrGround) {
  const TemporaryFolder folder;
  auto bare = one_plot();
  bare.plots[0].heights_m.clear();
  std::ranges::fill(bare.ground->z_m, std::numeric_limits<float>::quiet_NaN());
  draw_plot(plot_cloud(folder), bare, 7, folder.path() / "bare.png", {.width_px = 700});
  EXPECT_EQ(count_pixels(folder.path() / "bare.png", 0, 1, mean_line), 0);
  EXPECT_GT(count_pixels(folder.path() / "bare.png", 0, 1, crop_points), 100);
}

TEST(PlotPicture, RefusesWhatItCannotDraw) {
  const TemporaryFolder folder;
  const auto cloud = plot_cloud(folder);
  const auto png = folder.path() / "plot.png";
  const auto refusal = [&](const estimate::Estimate& estimate, std::uint32_t number,
                           const PlotPictureOptions& options) {
    return message_of<InputError>([&] { draw_plot(cloud, estimate, number, png, options); });
  };
  EXPECT_THAT(refusal(one_plot(), 8, {}), HasSubstr("there is no plot 8"));
  EXPECT_THAT(refusal({.method = "lattice", .ground = one_plot().ground}, 8, {}),
              HasSubstr("has no plots"));
  EXPECT_THAT(refusal(one_plot(), 7, {.heights = {"p94"}}),
              HasSubstr("no height 'p94'; it has: max, mean, p95"));
  EXPECT_THAT(refusal(one_plot(), 7, {.beyond_m = -1}), HasSubstr("beyond"));
  EXPECT_THAT(refusal(one_plot(), 7, {.width_px = 10}), HasSubstr("picture width"));
  const std::string long_name(200, 'x');
  estimate::Estimate wordy = one_plot();
  wordy.plots.front().heights_m[long_name] = 0.5;
  EXPECT_THAT(refusal(wordy, 7, {.width_px = 600, .heights = {long_name}}),
              HasSubstr("leave no room for the plot in a picture 600 px wide"));
  auto groundless = one_plot();
  groundless.ground.reset();
  EXPECT_THAT(refusal(groundless, 7, {}), HasSubstr("has no ground"));
  auto elsewhere = one_plot();
  elsewhere.plots[0].box.center -= kPlotOrigin;
  EXPECT_THAT(refusal(elsewhere, 7, {}), HasSubstr("has no point in plot 7"));
  EXPECT_FALSE(std::filesystem::exists(png));
}

}  // namespace
}  // namespace plotscan::view
