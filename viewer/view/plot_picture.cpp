// SPDX-License-Identifier: Apache-2.0
#include "view/plot_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "core/text.h"
#include "scan/cloud_reader.h"
#include "view/internal/axes.h"
#include "view/internal/display.h"
#include "view/internal/ground_profile.h"
#include "view/internal/height_lines.h"
#include "view/internal/page.h"
#include "view/internal/side_view.h"
#include "view/internal/window.h"

namespace plotscan::view {
namespace {

constexpr double kWidestPlot = 2;  // of the heights; wider pictures have smaller text
constexpr double kLeastChart = 5;  // height of the chart, in texts
constexpr Rgb kInside{0, 136, 96};
constexpr Rgb kBeyond = kGrey;
constexpr double kInterval = 1.96;  // standard errors
// Stray points above and below this share of all are not shown.
constexpr double kStray = 0.001;
constexpr std::array<double, 7> kExaggerations = {20, 10, 5, 3, 2, 1.5, 1};

using Profile = std::vector<ProfilePoint>;

void validate(const estimate::Estimate& estimate, const PlotPictureOptions& options) {
  require_range(options.width_px, PlotPictureOptions::kWidth_px, "picture width");
  require_range(options.height_px, PlotPictureOptions::kHeight_px, "picture height");
  require_range(options.beyond_m, PlotPictureOptions::kBeyond_m, "metres beyond the plot");
  if (!estimate.ground) throw InputError("the estimate has no ground");
}

const estimate::PlotEstimate& plot_named(const estimate::Estimate& estimate, const PlotId& id) {
  const auto found = std::ranges::find(estimate.plots, id, &estimate::PlotEstimate::id);
  if (found != estimate.plots.end()) return *found;
  if (estimate.plots.empty()) throw InputError("the estimate has no plots");
  throw InputError(fmt::format("there is no plot {}; the estimate's {} plots are {} to {}",
                               id.text(), estimate.plots.size(), estimate.plots.front().id.text(),
                               estimate.plots.back().id.text()));
}

// What is drawn of a plot.
struct Scene {
  const estimate::PlotEstimate& plot;
  Profile ground;         // with what lies beyond the plot
  Profile ground_inside;  // its heights stand on this
  std::vector<HeightLine> heights;
  SideView points;
};

Eigen::AlignedBox2d shown_part(const Scene& scene, double beyond_m) {
  auto z = list_of(scene.points.points(), [](const Eigen::Vector2d& point) { return point.y(); });
  double low = quantile(z, kStray);
  double high = quantile(std::move(z), 1 - kStray);
  for (const ProfilePoint& point : scene.ground) {
    if (std::isnan(point.z_m)) continue;
    low = std::min(low, point.z_m - kInterval * std::max(0.0, point.standard_error_m));
    high = std::max(high, point.z_m);
  }
  for (const HeightLine& height : scene.heights) {
    for (const ProfilePoint& point : scene.ground_inside)
      if (!std::isnan(point.z_m)) high = std::max(high, point.z_m + height.high_m);
  }
  const double air = 0.04 * std::max(0.1, high - low);
  return {Eigen::Vector2d(-beyond_m, low - air),
          Eigen::Vector2d(scene.plot.box.length_m + beyond_m, high + 1.5 * air)};
}

std::string title_of(const estimate::PlotEstimate& plot) {
  const std::string place = plot.row > 0 && plot.column > 0
                                ? fmt::format(" (row {}, column {})", plot.row, plot.column)
                                : "";
  return "Plot " + plot.id.text() + place;
}

std::string subtitle_of(const estimate::PlotEstimate& plot, double exaggeration) {
  std::string text =
      fmt::format("{:.2f} \u00d7 {:.2f} m, length {:.1f}\u00b0 from east; z drawn ",
                  plot.box.length_m, plot.box.width_m, plot.box.heading_rad / kDegrees);
  text +=
      exaggeration == 1 ? "to the same scale" : fmt::format("{:.3g} times as large", exaggeration);
  if (plot.confidence) text += fmt::format("; confidence {:.2f}", *plot.confidence);
  return text;
}

std::vector<LegendEntry> legend_of(double em) {
  using Mark = LegendEntry::Mark;
  return {{.mark = Mark::dots, .colour = kInside, .meaning = "points in the plot"},
          {.mark = Mark::dots, .colour = kBeyond, .meaning = "points beyond its ends"},
          {.colour = kInk, .width_px = 0.12 * em, .meaning = "ground, seen"},
          {.colour = kInk,
           .width_px = 0.12 * em,
           .dash_px = 0.3 * em,
           .meaning = "ground, interpolated"},
          {.mark = Mark::area,
           .colour = {190, 190, 190},
           .meaning = "ground \u00b1 1.96 standard errors"}};
}

// The page from top to bottom: title, subtitle, flags, chart, legend.
struct PlotPage {
  Eigen::Vector2d page_px = Eigen::Vector2d::Zero();
  Axes axes = {};
  double exaggeration = 1;
  double text_px = 0;
  std::vector<std::string> flags;
  std::vector<LegendEntry> legend;
};

PlotPage lay_out_plot(const Scene& scene, const PlotPictureOptions& options) {
  PlotPage layout;
  layout.text_px = kTextShare * std::min(1.0 * options.width_px, kWidestPlot * options.height_px);
  const double em = layout.text_px;
  if (!scene.plot.flags.empty()) {
    layout.flags = wrapped("flagged: " + joined(scene.plot.flags, "; "), options.width_px - 2 * em,
                           {.size_px = em});
  }
  layout.legend = legend_of(em);
  const double legend_px =
      draw_legend(nullptr, {0, 0}, options.width_px - 2 * em, layout.legend, em);
  const double left = 6.2 * em;
  const double right = labels_width_px(scene.heights, em);
  const double below = 3.8 * em + legend_px;
  const double above = (3.8 + 1.4 * static_cast<double>(layout.flags.size())) * em;

  const Eigen::AlignedBox2d shown = shown_part(scene, options.beyond_m);
  const Eigen::Vector2d room(options.width_px - left - right,
                             std::max(kLeastChart * em, options.height_px - below - above));
  if (room.x() < kLeastChart * em) {
    throw InputError(
        fmt::format("the names of the plot's heights leave no room for the plot in a "
                    "picture {} px wide; choose shorter ones by --heights, or a "
                    "larger --width",
                    options.width_px));
  }
  const double px_per_m = room.cwiseQuotient(shown.sizes()).minCoeff();
  const auto fits = [&](double times) {
    return times * px_per_m * shown.sizes().y() <= room.y() + 1;
  };
  if (px_per_m * shown.sizes().x() >= room.x() - 1)
    layout.exaggeration = *std::ranges::find_if(kExaggerations, fits);
  const Eigen::Vector2d chart_px =
      (px_per_m * shown.sizes().cwiseProduct(Eigen::Vector2d(1, layout.exaggeration)))
          .array()
          .round();
  const Eigen::Vector2d corner(std::round(left), std::round(below));
  layout.axes = {.shown = shown, .frame_px = {corner, corner + chart_px}};
  layout.page_px = {options.width_px, std::ceil(below + chart_px.y() + above)};
  return layout;
}

// Solid where the ground was seen, dashed where not.
void add_ground(Page& page, const PlotPage& layout, const Profile& ground) {
  const auto error_places = [&](double times) {
    return [&layout, times](const ProfilePoint& point) {
      return layout.axes.at({point.along_m, point.z_m + times * point.standard_error_m});
    };
  };
  for (const ProfileRun& run : runs_of(ground, false)) {
    page.band(list_of(run, error_places(-kInterval)), list_of(run, error_places(kInterval)), kInk,
              0.28);
  }
  for (const ProfileRun& run : runs_of(ground, true)) {
    page.line(list_of(run, error_places(0)),
              {.colour = kInk,
               .width_px = 0.12 * layout.text_px,
               .dash_px = run.front().seen ? 0 : 0.3 * layout.text_px});
  }
}

void add_ends(Page& page, const PlotPage& layout, double length_m) {
  for (const double end_m : {0.0, length_m}) {
    const double x = layout.axes.at({end_m, 0}).x();
    page.line({{x, layout.axes.frame_px.min().y()}, {x, layout.axes.frame_px.max().y()}},
              {.colour = kGrey, .width_px = 0.06 * layout.text_px, .dash_px = layout.text_px / 2});
  }
}

void add_words(Page& page, const PlotPage& layout, const estimate::PlotEstimate& plot) {
  const double em = layout.text_px;
  double y = layout.page_px.y() - 1.2 * em;
  page.text({em, y}, title_of(plot), {.size_px = 1.2 * em, .bold = true});
  y -= 1.5 * em;
  page.text({em, y}, subtitle_of(plot, layout.exaggeration), {.size_px = em});
  for (const std::string& line : layout.flags) {
    y -= 1.4 * em;
    page.text({em, y}, line, {.size_px = em, .colour = kVermilion, .bold = true});
  }
  const double legend_top = layout.axes.frame_px.min().y() - 3.6 * em;
  draw_legend(&page, {em, legend_top}, layout.page_px.x() - 2 * em, layout.legend, em);
}

}  // namespace

void draw_plot(const std::filesystem::path& cloud, const estimate::Estimate& estimate,
               const PlotId& id, const std::filesystem::path& png,
               const PlotPictureOptions& options) {
  validate(estimate, options);
  require_file(cloud);
  const estimate::PlotEstimate& plot = plot_named(estimate, id);
  Scene scene{.plot = plot,
              .ground = ground_profile(*estimate.ground, plot.box, options.beyond_m),
              .ground_inside = ground_profile(*estimate.ground, plot.box, 0),
              .heights = height_lines(plot, options.heights),
              .points = SideView(plot.box, options.beyond_m)};
  const Display display;
  CloudFiles files(cloud);
  files.units = estimate.units;
  scan::read_positions(files, [&](auto points) { scene.points.add(points); });
  if (scene.points.points().empty()) {
    throw InputError(
        cloud,
        "has no point in plot {}; is it the cloud of this estimate, in the same coordinates?",
        id.text());
  }
  const PlotPage layout = lay_out_plot(scene, options);

  Page page(layout.page_px);
  page.raster(layout.axes.frame_px.min(), scene.points.drawn(layout.axes, kInside, kBeyond));
  add_ends(page, layout, plot.box.length_m);
  add_ground(page, layout, scene.ground);
  draw_heights(page, layout.axes, scene.ground_inside, scene.heights, layout.text_px);
  draw_axes(page, layout.axes, "distance along the plot", "z", layout.text_px);
  add_words(page, layout, plot);
  page.write(png);
}

}  // namespace plotscan::view
