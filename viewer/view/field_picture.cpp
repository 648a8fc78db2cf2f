// SPDX-License-Identifier: Apache-2.0
#include "view/field_picture.h"

#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "heights/flags.h"
#include "scan/cloud_reader.h"
#include "view/internal/axes.h"
#include "view/internal/box_labels.h"
#include "view/internal/display.h"
#include "view/internal/height_colours.h"
#include "view/internal/page.h"
#include "view/internal/top_heights.h"
#include "view/internal/window.h"

namespace plotscan::view {
namespace {

constexpr double kWidest = 1.6;       // of the heights; wider pictures have smaller text
constexpr double kLeastWidth = 42;    // of the page in texts, for title and legend
constexpr double kLabelShare = 0.85;  // of the other text
constexpr double kLineShare = 0.06;   // of the boxes' shorter side
constexpr Rgb kPlotColour = kBlue;
constexpr Rgb kFlaggedColour = kVermilion;
// The colour scale ends at this quantile of the pixels, so that stray points do not bleach all
// others.
constexpr double kColouredShare = 0.995;
constexpr double kLeastTop_m = 0.1;

void validate(const estimate::Estimate& estimate, const FieldPictureOptions& options) {
  require_range(options.width_px, FieldPictureOptions::kSize_px, "picture width");
  require_range(options.height_px, FieldPictureOptions::kSize_px, "picture height");
  require_range(options.margin_m, FieldPictureOptions::kMargin_m, "margin in metres");
  if (!estimate.ground) throw InputError("the estimate has no ground");
}

Eigen::AlignedBox2d shown_part(const estimate::Estimate& estimate, double margin_m) {
  const Eigen::AlignedBox2d part = extent_of(estimate.plots, &estimate::PlotEstimate::box);
  if (part.isEmpty()) {
    const ground::Surface& ground = *estimate.ground;
    const Eigen::Vector2d nodes(ground.columns - 1, ground.rows - 1);
    return {ground.origin, ground.origin + ground.cell_m * nodes};
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return {part.min() - margin, part.max() + margin};
}

// Whether a flag speaks of the plot as a whole, not of one of its heights.
bool is_flagged(const estimate::PlotEstimate& plot) {
  return !std::ranges::all_of(plot.flags, [](const std::string& flag) {
    return heights::height_of_flag(flag).has_value();
  });
}

std::size_t flagged(const estimate::Estimate& estimate) {
  return std::ranges::count_if(estimate.plots, is_flagged);
}

std::string title_of(const estimate::Estimate& estimate) {
  if (estimate.plots.empty()) return "no plots found";
  return fmt::format("{} plots, {} flagged", estimate.plots.size(), flagged(estimate));
}

// Where the map and its surroundings lie on the page.
struct FieldPage {
  Eigen::Vector2d page_px = Eigen::Vector2d::Zero();
  Axes axes = {};
  double text_px = 0;
};

FieldPage lay_out_page(const Eigen::AlignedBox2d& shown, const FieldPictureOptions& options) {
  FieldPage layout;
  layout.text_px = kTextShare * std::min(1.0 * options.width_px, kWidest * options.height_px);
  const double em = layout.text_px;
  const Eigen::Vector2d before(5.2 * em, 4.2 * em);  // marks and titles, left and below
  const Eigen::Vector2d behind(7.2 * em, 4.6 * em);  // colour bar at the right, title on top
  const Eigen::Vector2d room =
      Eigen::Vector2d(options.width_px, options.height_px) - before - behind;
  const double px_per_m = room.cwiseQuotient(shown.sizes()).minCoeff();
  const Eigen::Vector2d map_px = (px_per_m * shown.sizes()).array().floor().max(1.0).matrix();
  layout.axes.shown = {shown.min(), shown.min() + map_px / px_per_m};
  layout.axes.frame_px = {before.array().round().matrix(),
                          before.array().round().matrix() + map_px};
  layout.page_px = (before + map_px + behind).array().ceil();
  layout.page_px.x() = std::max(layout.page_px.x(), kLeastWidth * em);
  return layout;
}

// Width of the boxes' lines: thinner where boxes are small.
double line_px(const Axes& axes, const estimate::Estimate& estimate, double text_px) {
  double shortest_m = std::numeric_limits<double>::infinity();
  for (const estimate::PlotEstimate& plot : estimate.plots)
    shortest_m = std::min({shortest_m, plot.box.width_m, plot.box.length_m});
  return std::clamp(kLineShare * shortest_m * axes.px_per_m().x(), 0.05 * text_px, 0.12 * text_px);
}

void add_boxes(Page& page, const Axes& axes, const estimate::Estimate& estimate, double text_px) {
  const double width_px = line_px(axes, estimate, text_px);
  // Flagged ones last, over their neighbours.
  for (const bool with_flags : {false, true}) {
    for (const estimate::PlotEstimate& plot : estimate.plots) {
      if (is_flagged(plot) != with_flags) continue;
      auto outline =
          list_of(plot.box.corners(), [&](const auto& corner) { return axes.at(corner); });
      outline.push_back(outline.front());
      outline.push_back(outline[1]);  // so that the first corner is closed
      // White beside it keeps the line apart from a dark canopy.
      page.line(outline, {.colour = kWhite, .width_px = (with_flags ? 2.4 : 2) * width_px});
      page.line(outline, {.colour = with_flags ? kFlaggedColour : kPlotColour,
                          .width_px = (with_flags ? 1.4 : 1) * width_px});
    }
  }
}

void add_labels(Page& page, const Axes& axes, const estimate::Estimate& estimate, double text_px) {
  std::vector<BoxLabel> labels;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    PlotBox box = plot.box;
    box.center = axes.at(box.center);
    box.width_m *= axes.px_per_m().x();
    box.length_m *= axes.px_per_m().x();
    labels.push_back({plot.id.text(), box, is_flagged(plot)});
  }
  for (const PlacedLabel& label : place_labels(labels, kLabelShare * text_px)) {
    const Lettering lettering{
        .size_px = label.size_px, .across = Side::middle, .turn_rad = label.turn_rad, .bold = true};
    page.area(label.corners, kWhite, 0.7);
    page.text(labels[label.index].box_px.center, labels[label.index].text, lettering);
  }
}

void add_title(Page& page, const FieldPage& layout, const estimate::Estimate& estimate,
               bool groundless) {
  const double em = layout.text_px;
  const double left = layout.axes.frame_px.min().x();
  page.text({left, layout.page_px.y() - 1.3 * em}, title_of(estimate),
            {.size_px = 1.2 * em, .bold = true});
  std::vector<LegendEntry> entries;
  if (flagged(estimate) < estimate.plots.size()) {
    entries.push_back(
        {.colour = kPlotColour, .width_px = 0.12 * em, .meaning = "plot with its number"});
  }
  if (flagged(estimate) > 0)
    entries.push_back({.colour = kFlaggedColour, .width_px = 0.17 * em, .meaning = "flagged plot"});
  if (groundless) {
    entries.push_back({.mark = LegendEntry::Mark::area,
                       .colour = kNoGroundColour,
                       .meaning = "no ground within reach"});
  }
  draw_legend(&page, {left, layout.page_px.y() - 2.5 * em}, layout.page_px.x() - left, entries, em);
}

}  // namespace

void draw_field(const std::filesystem::path& cloud, const estimate::Estimate& estimate,
                const std::filesystem::path& png, const FieldPictureOptions& options) {
  validate(estimate, options);
  require_file(cloud);
  const Display display;
  const FieldPage layout = lay_out_page(shown_part(estimate, options.margin_m), options);
  const Axes& axes = layout.axes;
  TopHeights tops(axes.shown, axes.frame_px.sizes().cast<int>());
  CloudFiles files(cloud);
  files.units = estimate.units;
  scan::read_positions(files, [&](auto points) { tops.add(points, *estimate.ground); });
  if (tops.points() == 0) {
    throw InputError(cloud,
                     "has no point in the estimate's field; is it the cloud of this "
                     "estimate, in the same coordinates?");
  }
  const HeightColours colours{.top_m = std::max(kLeastTop_m, tops.quantile_m(kColouredShare))};

  Page page(layout.page_px);
  page.raster(axes.frame_px.min(), tops.drawn(colours));
  add_boxes(page, axes, estimate, layout.text_px);
  add_labels(page, axes, estimate, layout.text_px);
  draw_axes(page, axes, "east", "north", layout.text_px);
  const double em = layout.text_px;
  const Eigen::Vector2d corner(axes.frame_px.max().x() + 1.2 * em, axes.frame_px.min().y());
  const double bar_px = std::min(axes.frame_px.sizes().y(), 22 * em);
  draw_colour_bar(page, colours, {corner, corner + Eigen::Vector2d(em, bar_px)},
                  "height above ground (m)", em);
  add_title(page, layout, estimate, tops.groundless());
  page.write(png);
}

}  // namespace plotscan::view
