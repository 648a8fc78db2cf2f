// SPDX-License-Identifier: Apache-2.0
#include "plots/search/find_trials.h"

#include <algorithm>
#include <cstddef>
#include <utility>

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

// Whether one trial is all that shows. What is much lower counts little beside it: other looks show
// that.
bool is_all(const Looks& looks) {
  const Look& one = looks.best;
  if (one.evidence == 0 || one.explained <= kNearlyAll || one.field.others_m2 > 0) return false;
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
         (many_more || (one.explained <= kNearlyAll && lie_apart(trials)));
}

double from_south_west_m(const SeenTrial& trial) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PlotBox& box : trial.area) sum += box.center;
  return sum.sum() / static_cast<double>(trial.area.size());
}

}  // namespace

std::vector<PlotField> find_trials(std::span<const Eigen::Vector3f> points, double noise_m,
                                   const Hints& hints, int threads,
                                   const GroundError& ground_error) {
  const ScannedField field{points, noise_m, hints, threads, ground_error};
  const Looks looks = look_in_all_ways(field);
  const Look& one = looks.best;
  if (is_all(looks) || hints.tell_layout()) return {one.field};
  std::vector<SeenTrial> trials = trials_beside(field, looks);
  if (!explain_more(trials, one)) return {one.field};
  std::ranges::sort(trials, {}, from_south_west_m);
  std::vector<PlotField> fields;
  fields.reserve(trials.size());
  for (SeenTrial& trial : trials) fields.push_back(std::move(trial.look.field));
  return fields;
}

}  // namespace plotscan::plots
