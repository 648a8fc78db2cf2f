// SPDX-License-Identifier: Apache-2.0
#include "view/field_picture.h"

#include <array>
#include <limits>

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

const Eigen::Vector2d kOrigin(552000, 4128000);
constexpr double kSlope = 0.3;
constexpr double kCrop_m = 0.8;

// A plot of 4 x 2 m, and one of the same size east of it; on ground that falls from 300 m.
estimate::Estimate two_plots(bool flagged) {
  estimate::Estimate estimate{.method = "lattice"};
  estimate.ground = plane(kOrigin, 300, {-kSlope, 0}, 71);
  for (const double x : {4.0, 9.0}) {
    estimate.plots.push_back({.id = static_cast<std::uint32_t>(estimate.plots.size() + 1),
                              .box = {.center = kOrigin + Eigen::Vector2d(x, 7),
                                      .width_m = 2,
                                      .length_m = 4,
                                      .heading_rad = 0}});
  }
  if (flagged) estimate.plots[1].flags = {"too few returns"};
  estimate.plots[0].flags = {"mean height is unsure by centimetres"};  // of one height, not a plot
  return estimate;
}

std::filesystem::path cloud_of(const TemporaryFolder& folder) {
  const auto estimate = two_plots(false);
  return write_field(
      folder, kOrigin, kOrigin + Eigen::Vector2d(14, 14), 0.05, [&](const Eigen::Vector2d& place) {
        const bool crop =
            estimate.plots[0].box.contains(place) || estimate.plots[1].box.contains(place);
        return 300 - kSlope * (place - kOrigin).x() + (crop ? kCrop_m : 0);
      });
}

bool blue_line(const Colour& c) { return c[2] > c[0] + 120 && c[2] > 150; }
bool vermilion(const Colour& c) { return c[0] > 190 && c[1] < 120 && c[2] < 60; }
bool darkest_crop(const Colour& c) { return c[0] < 12 && std::abs(c[1] - 69) < 12 && c[2] < 55; }
bool bare_ground(const Colour& c) { return c[0] > 235 && c[1] > 240 && c[2] < 215; }

// Around all pixels below the legend that `wanted` holds: left, right, low, high.
std::array<int, 4> extent(const std::filesystem::path& png,
                          const std::function<bool(const Colour&)>& wanted) {
  int height = 0;
  for_pixels(png, [&](int, int y, const Colour&) { height = std::max(height, y + 1); });
  std::array<int, 4> found = {1 << 30, -1, 1 << 30, -1};
  for_pixels(png, [&](int x, int y, const Colour& colour) {
    if (y > 0.85 * height || !wanted(colour)) return;
    found = {std::min(found[0], x), std::max(found[1], x), std::min(found[2], y),
             std::max(found[3], y)};
  });
  return found;
}

TEST(FieldPicture, ShowsBoxesWhereTheyAreNorthUp) {
  const TemporaryFolder folder;
  const auto png = folder.path() / "field.png";
  draw_field(cloud_of(folder), two_plots(true), png, {.width_px = 800, .height_px = 700});
  const auto plain = extent(png, blue_line);
  const auto flagged = extent(png, vermilion);
  const double px_per_m = (flagged[1] - flagged[0]) / 4.0;
  ASSERT_GT(px_per_m, 30);
  EXPECT_NEAR((flagged[3] - flagged[2]) / px_per_m, 2, 0.1);
  EXPECT_NEAR((plain[1] - plain[0]) / px_per_m, 4, 0.1);
  EXPECT_NEAR((plain[3] - plain[2]) / px_per_m, 2, 0.1);
  EXPECT_NEAR((flagged[0] - plain[0]) / px_per_m, 5, 0.1) << "plot 2 lies 5 m east of plot 1";
  EXPECT_NEAR(flagged[2], plain[2], 3);

  // The crop fills the boxes and nothing else, whatever the slope.
  const auto crop = extent(png, [](const Colour& c) { return darkest_crop(c); });
  EXPECT_NEAR(crop[0], plain[0], 0.15 * px_per_m);
  int outside = 0;
  int inside = 0;
  for_pixels(png, [&](int x, int y, const Colour& c) {
    const bool in_box =
        x > plain[0] + 5 && x < plain[1] - 5 && y > plain[2] + 5 && y < plain[3] - 5;
    const bool beside = x > plain[1] + 5 && x < flagged[0] - 5 && y > plain[2] && y < plain[3];
    inside += in_box && bare_ground(c);
    outside += beside && !bare_ground(c);
  });
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(outside, 0);
}

TEST(FieldPicture, HasNoFlagColourWithoutFlags) {
  const TemporaryFolder folder;
  const auto png = folder.path() / "field.png";
  draw_field(cloud_of(folder), two_plots(false), png, {.width_px = 700, .height_px = 700});
  EXPECT_EQ(count_pixels(png, 0, 1, vermilion), 0);
  EXPECT_GT(count_pixels(png, 0, 1, blue_line), 100);
}

TEST(FieldPicture, OfNoPlotsShowsTheGround) {
  const TemporaryFolder folder;
  auto none = two_plots(false);
  none.plots.clear();
  draw_field(cloud_of(folder), none, folder.path() / "none.png",
             {.width_px = 600, .height_px = 600});
  EXPECT_EQ(count_pixels(folder.path() / "none.png", 0, 1, blue_line), 0);
  EXPECT_GT(count_pixels(folder.path() / "none.png", 0, 1, bare_ground), 5000);
  EXPECT_GT(count_pixels(folder.path() / "none.png", 0, 1, darkest_crop), 500);
}

TEST(FieldPicture, RefusesWhatItCannotDraw) {
  const TemporaryFolder folder;
  const auto png = folder.path() / "field.png";
  const auto cloud = cloud_of(folder);
  const auto refusal = [&](const estimate::Estimate& estimate, const FieldPictureOptions& options) {
    return message_of<InputError>([&] { draw_field(cloud, estimate, png, options); });
  };
  EXPECT_THAT(refusal(two_plots(true), {.width_px = 10}), HasSubstr("picture width"));
  EXPECT_THAT(refusal(two_plots(true), {.margin_m = -1}), HasSubstr("margin"));
  auto groundless = two_plots(true);
  groundless.ground.reset();
  EXPECT_THAT(refusal(groundless, {}), HasSubstr("has no ground"));
  auto elsewhere = two_plots(true);
  for (auto& plot : elsewhere.plots) plot.box.center -= kOrigin;
  EXPECT_THAT(refusal(elsewhere, {}), HasSubstr("has no point in the estimate's field"));
  EXPECT_FALSE(std::filesystem::exists(png));
}

}  // namespace
}  // namespace plotscan::view
