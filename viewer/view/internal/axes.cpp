// SPDX-License-Identifier: Apache-2.0
#include "view/internal/axes.h"

#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "view/internal/scale.h"

namespace plotscan::view {
namespace {

// Coordinates beyond it are counted from a round number.
constexpr double kLongCoordinate_m = 10'000;
constexpr double kRoundOrigin_m = 1000;

double origin_of(double low_m, double high_m) {
  if (std::max(std::abs(low_m), std::abs(high_m)) < kLongCoordinate_m) return 0;
  return std::floor(low_m / kRoundOrigin_m) * kRoundOrigin_m;
}

std::string with_unit(const std::string& title, double origin_m) {
  return title + (origin_m == 0 ? " (m)" : fmt::format(" (m, from {:.0f})", origin_m));
}

void draw_mark(Page& page, const LegendEntry& entry, const Eigen::Vector2d& left, double mark_px,
               double text_px) {
  const Eigen::Vector2d along(mark_px, 0);
  const Eigen::Vector2d half(0, 0.3 * text_px);
  if (entry.mark == LegendEntry::Mark::line) {
    page.line({left, left + along},
              {.colour = entry.colour, .width_px = entry.width_px, .dash_px = entry.dash_px});
  } else if (entry.mark == LegendEntry::Mark::area) {
    page.area({left - half, left + along - half, left + along + half, left + half}, entry.colour);
  } else {
    for (const double share : {0.2, 0.5, 0.8}) {
      const Eigen::Vector2d dot = left + share * along;
      const double r = 0.13 * text_px;
      page.area({dot + Eigen::Vector2d(-r, -r), dot + Eigen::Vector2d(r, -r),
                 dot + Eigen::Vector2d(r, r), dot + Eigen::Vector2d(-r, r)},
                entry.colour);
    }
  }
}

}  // namespace

void draw_axes(Page& page, const Axes& axes, const std::string& title_x, const std::string& title_y,
               double text_px) {
  const Eigen::Vector2d low = axes.frame_px.min();
  const Eigen::Vector2d high = axes.frame_px.max();
  const double tick_px = 0.35 * text_px;
  const Stroke thin{.colour = kInk, .width_px = text_px / 16};
  page.line({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, thin);

  const Eigen::Vector2d least_step = (3.5 * text_px * axes.px_per_m().cwiseInverse().array());
  const double origin_x = origin_of(axes.shown.min().x(), axes.shown.max().x());
  const Ticks across =
      ticks_between(axes.shown.min().x(), axes.shown.max().x(), 1.4 * least_step.x());
  for (const double x_m : across.values) {
    const double x = axes.at({x_m, axes.shown.min().y()}).x();
    page.line({{x, low.y()}, {x, low.y() - tick_px}}, thin);
    page.text({x, low.y() - 1.5 * tick_px}, across.text(x_m, origin_x),
              {.size_px = text_px, .across = Side::middle, .upwards = Side::high});
  }
  const double origin_y = origin_of(axes.shown.min().y(), axes.shown.max().y());
  const Ticks upwards =
      ticks_between(axes.shown.min().y(), axes.shown.max().y(), 0.7 * least_step.y());
  double widest_px = 0;
  for (const double y_m : upwards.values) {
    const double y = axes.at({axes.shown.min().x(), y_m}).y();
    const Lettering lettering{.size_px = text_px, .across = Side::high};
    page.line({{low.x(), y}, {low.x() - tick_px, y}}, thin);
    page.text({low.x() - 1.5 * tick_px, y}, upwards.text(y_m, origin_y), lettering);
    widest_px = std::max(widest_px, text_size_px(upwards.text(y_m, origin_y), lettering).x());
  }
  const Eigen::Vector2d middle = axes.frame_px.center();
  page.text({middle.x(), low.y() - 1.5 * tick_px - 1.3 * text_px}, with_unit(title_x, origin_x),
            {.size_px = text_px, .across = Side::middle, .upwards = Side::high});
  page.text(
      {low.x() - 1.5 * tick_px - widest_px - 0.5 * text_px, middle.y()},
      with_unit(title_y, origin_y),
      {.size_px = text_px, .across = Side::middle, .upwards = Side::low, .turn_rad = kPi / 2});
}

double draw_legend(Page* page, const Eigen::Vector2d& top_left, double width_px,
                   const std::vector<LegendEntry>& entries, double text_px) {
  const double line_px = 1.5 * text_px;
  const double mark_px = 1.8 * text_px;
  const Lettering lettering{.size_px = text_px};
  Eigen::Vector2d at = top_left - Eigen::Vector2d(0, line_px / 2);
  for (const LegendEntry& entry : entries) {
    const double entry_px = mark_px + 0.5 * text_px + text_size_px(entry.meaning, lettering).x();
    if (at.x() > top_left.x() && at.x() + entry_px > top_left.x() + width_px)
      at = {top_left.x(), at.y() - line_px};
    if (page != nullptr) {
      draw_mark(*page, entry, at, mark_px, text_px);
      page->text(at + Eigen::Vector2d(mark_px + 0.5 * text_px, 0), entry.meaning, lettering);
    }
    at.x() += entry_px + 1.3 * text_px;
  }
  return top_left.y() - at.y() + line_px / 2;
}

}  // namespace plotscan::view
