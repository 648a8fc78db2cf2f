// SPDX-License-Identifier: Apache-2.0
#include "view/internal/height_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/angle.h"
#include "view/internal/scale.h"

namespace plotscan::view {
namespace {

constexpr std::array<Rgb, 9> kSteps = {{{255, 255, 229},
                                        {247, 252, 185},
                                        {217, 240, 163},
                                        {173, 221, 142},
                                        {120, 198, 121},
                                        {65, 171, 93},
                                        {35, 132, 67},
                                        {0, 104, 55},
                                        {0, 69, 41}}};
// Bare ground is not the paper's white.
constexpr double kGround = 0.6;  // where 0 m lies among the steps

}  // namespace

Rgb mixed(const Rgb& from, const Rgb& to, double share) {
  const auto part = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
  };
  return {part(from.red, to.red), part(from.green, to.green), part(from.blue, to.blue)};
}

Rgb HeightColours::of(double height_m) const {
  const double last = static_cast<double>(kSteps.size() - 1);
  const double at = kGround + std::clamp(height_m / top_m, 0.0, 1.0) * (last - kGround);
  const auto step = std::min(static_cast<std::size_t>(at), kSteps.size() - 2);
  return mixed(kSteps[step], kSteps[step + 1], at - static_cast<double>(step));
}

void draw_colour_bar(Page& page, const HeightColours& colours, const Eigen::AlignedBox2d& bar_px,
                     const std::string& title, double text_px) {
  const Eigen::Vector2i size = bar_px.sizes().cast<int>();
  Raster bar{.width = size.x(), .height = size.y()};
  for (int row = 0; row < size.y(); ++row) {
    const Rgb colour = colours.of(colours.top_m * (row + 0.5) / size.y());
    bar.pixels.insert(bar.pixels.end(), static_cast<std::size_t>(size.x()), colour);
  }
  page.raster(bar_px.min(), bar);
  const Eigen::Vector2d& low = bar_px.min();
  const Eigen::Vector2d& high = bar_px.max();
  const Stroke thin{.colour = kInk, .width_px = text_px / 16};
  page.line({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, thin);

  const double px_per_m = bar_px.sizes().y() / colours.top_m;
  const Ticks ticks = ticks_between(0, colours.top_m, 2 * text_px / px_per_m);
  double widest_px = 0;
  for (const double tick_m : ticks.values) {
    const double y = low.y() + tick_m * px_per_m;
    const Lettering lettering{.size_px = text_px};
    page.line({{high.x(), y}, {high.x() + 0.35 * text_px, y}}, thin);
    page.text({high.x() + 0.6 * text_px, y}, ticks.text(tick_m), lettering);
    widest_px = std::max(widest_px, text_size_px(ticks.text(tick_m), lettering).x());
  }
  page.text(
      {high.x() + text_px + widest_px, bar_px.center().y()}, title,
      {.size_px = text_px, .across = Side::middle, .upwards = Side::high, .turn_rad = kPi / 2});
}

}  // namespace plotscan::view
