// SPDX-License-Identifier: Apache-2.0
#include "plots/search/find_trials.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/core.h>

#include "plots/canopy/field_blocks.h"
#include "plots/search/internal/scan_edge.h"
#include "plots/search/internal/told_layout.h"
#include "plots/search/internal/trial_area.h"
#include "plots/search/internal/trials_beside.h"

namespace plotscan::plots {
namespace {

// Whether most of what was found lies outside of a trial.
bool lies_outside(const Look& look, const std::vector<PlotBox>& area) {
  const auto outside = std::ranges::count_if(look.field.plots, [&](const FoundPlot& plot) {
    return std::ranges::none_of(area,
                                [&](const PlotBox& box) { return box.contains(plot.box.center); });
  });
  return 2 * outside > std::ssize(look.field.plots);
}

// Whether a trial leaves nothing of the field to others: boxes at whose sides canopy does not end
// are cut out of it.
bool leaves_nothing(const Look& one) {
  constexpr std::size_t kCutOut = 3;  // of so many plots not one
  return one.explained > kNearlyAll && kCutOut * one.edgeless <= one.field.plots.size();
}

// Whether one trial is all that shows. What is much lower counts little beside it: other looks show
// that.
bool is_all(const Looks& looks) {
  const Look& one = looks.best;
  if (one.evidence == 0 || one.field.others_m2 > 0 || !leaves_nothing(one)) return false;
  const std::vector<PlotBox> area = area_of(one.field.fit->layout);
  return std::ranges::none_of(looks.at_all, [&](const Look& look) {
    return look.field.plots.size() >= kLeastOfTrial && lies_outside(look, area);
  });
}

// Whether none of the trials has plots among those of another.
bool lie_apart(const std::vector<SeenTrial>& trials) {
  return std::ranges::all_of(trials, [&](const SeenTrial& trial) {
    const PlotBox outline = outline_of(trial.look.field.fit->layout);
    return std::ranges::none_of(trials, [&](const SeenTrial& other) {
      return &other != &trial && std::ranges::any_of(other.area, [&](const PlotBox& box) {
        return outline.contains(box.center);
      });
    });
  });
}

// Whether these explain the field better than one trial does. Parts of one trial, such as its outer
// rows, are as many plots: where one explains all, or they lie among each other, there must be
// more.
bool explain_more(const std::vector<SeenTrial>& trials, const Look& one) {
  std::size_t plots = 0;
  for (const SeenTrial& trial : trials) plots += trial.look.field.plots.size();
  const bool many_more = plots >= one.field.plots.size() + kLeastOfTrial;
  return trials.size() > 1 && expected_plots(trials) > expected_plots(one) &&
         (many_more || (!leaves_nothing(one) && lie_apart(trials)));
}

double from_south_west_m(const SeenTrial& trial) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PlotBox& box : trial.area) sum += box.center;
  return sum.sum() / static_cast<double>(trial.area.size());
}

// The trials of a field of which no layout is told.
std::vector<PlotField> trials_shown(const ScannedField& field) {
  const Looks looks = look_in_all_ways(field);
  const Look& one = looks.best;
  if (is_all(looks)) return {one.field};
  std::vector<SeenTrial> trials = trials_beside(field, looks);
  if (!explain_more(trials, one)) return {one.field};
  std::ranges::sort(trials, {}, from_south_west_m);
  std::vector<PlotField> fields;
  fields.reserve(trials.size());
  for (SeenTrial& trial : trials) fields.push_back(std::move(trial.look.field));
  return fields;
}

// A single rectangle of canopy may be a whole crop as well as a plot, and nothing but the user says
// which.
void leave_out_whole_crop(std::vector<PlotField>& trials) {
  constexpr double kMostAlone_m2 = 100;  // drawn plots: up to 25; crops: 140 and more
  PlotField& field = trials.front();
  if (trials.size() > 1 || field.plots.size() != 1) return;
  const PlotBox& box = field.plots.front().box;
  if (box.width_m * box.length_m <= kMostAlone_m2) return;
  field.why_none = fmt::format(
      "a single rectangle of {:.1f} x {:.1f} m lies here, which may be a whole crop; "
      "if it is one plot, give --plots 1",
      box.width_m, box.length_m);
  field.plots.clear();
}

// Whether nothing speaks against plots that are of the layout told.
bool is_clear(const PlotField& told) {
  return !told.plots.empty() && told.rival.empty() && told.doubt.empty();
}

// Those of the hints that are left without one of two sides; without all of them but the heading;
// and without the sides, or the numbers.
std::vector<Hints> fewer_hints(const Hints& all) {
  std::vector<Hints> fewer;
  if (all.width_m && all.length_m) {
    Hints width = all, length = all;
    width.length_m = length.width_m = std::nullopt;
    fewer.insert(fewer.end(), {width, length});
  }
  fewer.push_back({.heading_rad = all.heading_rad});
  if ((all.width_m || all.length_m) && (all.rows || all.columns || all.plots)) {
    Hints numbers = all, sides = all;
    numbers.width_m = numbers.length_m = std::nullopt;
    sides.rows = sides.columns = sides.plots = std::nullopt;
    fewer.insert(fewer.end(), {numbers, sides});
  }
  return fewer;
}

// The trial of which the user told the layout. Its numbers and sides say nothing of what else
// stands on the field: where plots do not show with all of them, they may with fewer, and agree
// with all.
PlotField trial_told(const ScannedField& field) {
  PlotField told = look_in_all_ways(field).best.field;
  if (is_clear(told)) return told;
  for (const Hints& hints : fewer_hints(field.hints)) {
    const ScannedField less{field.points, field.blocks,  field.noise_m,
                            hints,        field.threads, field.ground_error};
    for (const PlotField& shown :
         hints.tell_layout() ? std::vector{look_in_all_ways(less).best.field} : trials_shown(less))
      if (!shown.plots.empty() && shown.rival.empty() && is_as_told(shown.fit->layout, field.hints))
        return with_sides(shown, field.hints);
  }
  return told;
}

// Marks the plots at which the scanned area ends.
void mark_cut_off(std::vector<PlotField>& trials, const FieldBlocks& blocks) {
  const auto is_scanned = [&](const Eigen::Vector2d& place) { return blocks.is_scanned(place); };
  for (PlotField& trial : trials)
    for (FoundPlot& plot : trial.plots) plot.cut_off = is_cut_off(plot.box, is_scanned);
}

}  // namespace

std::vector<PlotField> find_trials(std::span<const Eigen::Vector3f> points, double noise_m,
                                   const Hints& hints, int threads,
                                   const GroundError& ground_error) {
  const FieldBlocks blocks(points, noise_m, threads);
  const ScannedField field{points, blocks, noise_m, hints, threads, ground_error};
  std::vector<PlotField> trials =
      hints.tell_layout() ? std::vector{trial_told(field)} : trials_shown(field);
  if (!hints.tell_layout()) leave_out_whole_crop(trials);
  mark_cut_off(trials, blocks);
  return trials;
}

}  // namespace plotscan::plots
