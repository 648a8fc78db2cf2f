// SPDX-License-Identifier: Apache-2.0
#include "view/internal/height_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/core.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"

namespace plotscan::view {
namespace {

constexpr std::size_t kMostLines = 4;

struct NamedColour {
  std::string_view name;
  Rgb colour;
};
// Each usual height has its own, the same as in reports (report/src/heights.ts).
constexpr std::array<NamedColour, 8> kOfHeights = {{{"max", kBlue},
                                                    {"p99", kOrange},
                                                    {"p95", kPurple},
                                                    {"p90", kDarkGrey},
                                                    {"p50", kIndigo},
                                                    {"mean", kVermilion},
                                                    {"canopy_p99", kGreen},
                                                    {"canopy_p95", kSky}}};
constexpr std::array<Rgb, kMostLines> kOfOthers = {kBlue, kVermilion, kPurple, kOrange};
constexpr double kIntervalOpacity = 0.3;

std::optional<Rgb> own_colour(const std::string& name) {
  const auto* const own = std::ranges::find(kOfHeights, name, &NamedColour::name);
  return own == kOfHeights.end() ? std::nullopt : std::optional(own->colour);
}

// The names' colours; other heights get the first that none has.
std::vector<Rgb> colours_of(const std::vector<std::string>& names) {
  const auto own = list_of(names, own_colour);
  std::vector<Rgb> colours;
  for (const auto& colour : own) {
    const auto is_free = [&](const Rgb& other) {
      return !contains(own, std::optional(other)) && !contains(colours, other);
    };
    colours.push_back(colour ? *colour : *std::ranges::find_if(kOfOthers, is_free));
  }
  return colours;
}

std::vector<std::string> all_names(const estimate::PlotEstimate& plot) {
  return list_of(plot.heights_m, [](const auto& height) { return height.first; });
}

std::vector<std::string> usual_names(const estimate::PlotEstimate& plot) {
  std::vector<std::string> names;
  for (const char* name : {"mean", "p95", "max"})
    if (plot.heights_m.contains(name)) names.emplace_back(name);
  if (names.empty()) names = all_names(plot);
  names.resize(std::min(names.size(), kMostLines));
  return names;
}

// Where labels stand, as near to their lines as leaves `apart` between them; `wanted` ascends.
std::vector<double> spread_out(std::vector<double> wanted, double apart, double low, double high) {
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = std::max(wanted[i], i == 0 ? low : wanted[i - 1] + apart);
  for (std::size_t i = wanted.size(); i-- > 0;)
    wanted[i] = std::min(wanted[i], i + 1 == wanted.size() ? high : wanted[i + 1] - apart);
  return wanted;
}

void draw_line(Page& page, const Axes& axes, const std::vector<ProfilePoint>& ground,
               const HeightLine& height, double text_px) {
  const auto over_ground = [&](double height_m) {
    return [&axes, height_m](const ProfilePoint& point) {
      return axes.at({point.along_m, point.z_m + height_m});
    };
  };
  for (const ProfileRun& run : runs_of(ground, false)) {
    if (height.has_interval) {
      page.band(list_of(run, over_ground(height.low_m)), list_of(run, over_ground(height.high_m)),
                height.colour, kIntervalOpacity);
    }
    page.line(list_of(run, over_ground(height.height_m)),
              {.colour = height.colour, .width_px = 0.12 * text_px});
  }
}

// Pixels from the chart, in text sizes: leaders' ends, and labels.
constexpr double kLeader = 0.8;
constexpr double kLabel = 1.1;

struct Label {
  std::string height;
  std::string interval;  // "" where there is none
  Lettering large;
  Lettering small;
};

Label label_of(const HeightLine& height, double text_px) {
  std::string name = height.name;
  std::ranges::replace(name, '_', ' ');
  return {.height = name + fmt::format(" {:.3f} m", height.height_m),
          .interval = height.has_interval
                          ? fmt::format("95 %: {:.3f} to {:.3f} m", height.low_m, height.high_m)
                          : "",
          .large = {.size_px = text_px, .bold = true},
          .small = {.size_px = 0.85 * text_px}};
}

void draw_label(Page& page, const Eigen::Vector2d& place, const Label& label, double text_px) {
  const double up_px = label.interval.empty() ? 0 : 0.55 * text_px;
  page.text(place + Eigen::Vector2d(0, up_px), label.height, label.large);
  if (!label.interval.empty())
    page.text(place - Eigen::Vector2d(0, up_px), label.interval, label.small);
}

}  // namespace

std::vector<HeightLine> height_lines(const estimate::PlotEstimate& plot,
                                     const std::vector<std::string>& names) {
  if (names.size() > kMostLines)
    throw InputError(
        fmt::format("{} heights are given; {} are drawn at most", names.size(), kMostLines));
  const std::vector<std::string> drawn = names.empty() ? usual_names(plot) : names;
  const std::vector<Rgb> colours = colours_of(drawn);
  std::vector<HeightLine> lines;
  for (const std::string& name : drawn) {
    const auto height = plot.heights_m.find(name);
    if (height == plot.heights_m.end()) {
      throw InputError(fmt::format("plot {} has no height '{}'; it has: {}", plot.id.text(), name,
                                   joined(all_names(plot), ", ")));
    }
    HeightLine line{.name = name,
                    .height_m = height->second,
                    .low_m = height->second,
                    .high_m = height->second,
                    .colour = colours[lines.size()]};
    const auto error = plot.errors.find(name);
    if (error != plot.errors.end()) {
      line.low_m = error->second.low95_m;
      line.high_m = error->second.high95_m;
      line.has_interval = true;
    }
    lines.push_back(line);
  }
  return lines;
}

double labels_width_px(const std::vector<HeightLine>& heights, double text_px) {
  double widest_px = 0;
  for (const HeightLine& height : heights) {
    const Label label = label_of(height, text_px);
    widest_px = std::max({widest_px, text_size_px(label.height, label.large).x(),
                          text_size_px(label.interval, label.small).x()});
  }
  return widest_px + (kLabel + 0.6) * text_px;
}

void draw_heights(Page& page, const Axes& axes, const std::vector<ProfilePoint>& ground,
                  const std::vector<HeightLine>& heights, double text_px) {
  for (const HeightLine& height : heights) draw_line(page, axes, ground, height, text_px);
  // Labels belong to the lines' right ends.
  const auto last = std::ranges::find_if(ground.rbegin(), ground.rend(),
                                         [](const auto& point) { return !std::isnan(point.z_m); });
  std::vector<HeightLine> upwards = heights;
  std::ranges::stable_sort(upwards, {}, &HeightLine::height_m);
  std::vector<double> ends;
  for (const HeightLine& height : upwards) {
    const double z_m = last == ground.rend() ? axes.shown.max().y() : last->z_m + height.height_m;
    ends.push_back(axes.at({0, z_m}).y());
  }
  const std::vector<double> places =
      spread_out(ends, 2.5 * text_px, axes.frame_px.min().y() + text_px,
                 axes.frame_px.max().y() - 0.9 * text_px);
  const double edge = axes.frame_px.max().x();
  for (std::size_t i = 0; i < upwards.size(); ++i) {
    if (last != ground.rend()) {
      const Stroke leader{.colour = upwards[i].colour, .width_px = 0.09 * text_px};
      page.line({{axes.at({last->along_m, 0}).x(), ends[i]},
                 {edge, ends[i]},
                 {edge + kLeader * text_px, places[i]}},
                leader);
    }
    draw_label(page, {edge + kLabel * text_px, places[i]}, label_of(upwards[i], text_px), text_px);
  }
}

}  // namespace plotscan::view
