// SPDX-License-Identifier: Apache-2.0
#include "plots/find_trials.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "plots/internal/trial_area.h"
#include "plots/internal/trial_search.h"

namespace plotscan::plots {
namespace {

constexpr std::size_t kMostTrials = 6;
constexpr std::size_t kLeastOfTrial = 4;  // of a trial beside others: fewer may be anything
constexpr int kMostRounds = 3;
constexpr double kNearlyAll = 0.97;  // of what stands on a field: what is left is no trial

// A trial on the way, and where it was last seen to lie.
struct Trial {
  std::vector<PlotBox> area;
  Look look = {};
};

std::vector<Eigen::Vector3f> without(const ScannedField& field, const std::vector<Trial>& trials,
                                     const Trial* kept = nullptr) {
  std::vector<PlotBox> areas;
  for (const Trial& trial : trials)
    if (&trial != kept) areas.insert(areas.end(), trial.area.begin(), trial.area.end());
  return points_outside(field.points, areas);
}

Look look_outside(const ScannedField& field, const std::vector<Trial>& trials,
                  const Trial* kept = nullptr) {
  const std::vector<Eigen::Vector3f> points = without(field, trials, kept);
  ScannedField part = field;
  part.points = points;
  return look_once(part);
}

// Adds one trial after the other, each in what the ones before leave of the canopy. It need not
// convince yet, as those that are still to come disturb its picture.
void propose(const ScannedField& field, Look look, std::vector<Trial>& trials) {
  while (look.may_be >= kLeastOfTrial && trials.size() < kMostTrials) {
    trials.push_back({.area = area_of(look.field.fit->layout)});
    look = look_outside(field, trials);
  }
}

// Looks at a trial with the others taken away. Whether it is a field of plots then.
bool is_confirmed(const ScannedField& field, const std::vector<Trial>& trials, Trial& trial) {
  trial.look = look_outside(field, trials, &trial);
  if (trial.look.field.plots.size() < kLeastOfTrial) return false;
  trial.area = area_of(trial.look.field.fit->layout);
  return true;
}

void drop_unconfirmed(const ScannedField& field, std::vector<Trial>& trials) {
  for (std::size_t i = 0; i < trials.size();) {
    if (is_confirmed(field, trials, trials[i]))
      ++i;
    else
      trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// The trials that are fields of plots with all others taken away. Once the first ones are
// confirmed, it shows more clearly where further ones lie.
std::vector<Trial> told_apart(const ScannedField& field, const Look& first) {
  std::vector<Trial> trials;
  propose(field, first, trials);
  if (trials.size() < 2) return {};
  drop_unconfirmed(field, trials);
  if (trials.empty()) return {};
  propose(field, look_outside(field, trials), trials);
  for (int round = 0; round < kMostRounds && trials.size() > 1; ++round) {
    const std::size_t before = trials.size();
    drop_unconfirmed(field, trials);
    if (trials.size() == before) return trials;
  }
  return {};
}

// Whether none of the trials has plots among those of another.
bool lie_apart(const std::vector<Trial>& trials) {
  return std::ranges::all_of(trials, [&](const Trial& trial) {
    const PlotBox outline = outline_of(trial.look.field.fit->layout);
    return std::ranges::none_of(trials, [&](const Trial& other) {
      return &other != &trial && std::ranges::any_of(other.area, [&](const PlotBox& box) {
        return outline.contains(box.center);
      });
    });
  });
}

// Whether these explain the field better than one trial does. Parts of one trial, such as its outer
// rows, are as many plots and lie among each other.
bool explain_more(const std::vector<Trial>& trials, const Look& one) {
  double expected = 0;
  std::size_t plots = 0;
  for (const Trial& trial : trials) {
    expected += expected_plots(trial.look);
    plots += trial.look.field.plots.size();
  }
  return trials.size() > 1 && expected > expected_plots(one) &&
         (lie_apart(trials) || plots >= one.field.plots.size() + kLeastOfTrial);
}

double from_south_west_m(const Trial& trial) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PlotBox& box : trial.area) sum += box.center;
  return sum.sum() / static_cast<double>(trial.area.size());
}

}  // namespace

std::vector<PlotField> find_trials(std::span<const Eigen::Vector3f> points, double noise_m,
                                   const Hints& hints, int threads,
                                   const GroundError& ground_error) {
  const ScannedField field{points, noise_m, hints, threads, ground_error};
  const auto [first, one] = look_in_all_ways(field);
  const bool found = one.evidence > 0;
  const bool is_all = found && one.explained > kNearlyAll && one.field.others_m2 == 0;
  if (is_all || hints.tell_layout()) return {one.field};
  std::vector<Trial> trials = told_apart(field, found ? one : first);
  if (!explain_more(trials, one)) return {one.field};
  std::ranges::sort(trials, {}, from_south_west_m);
  std::vector<PlotField> fields;
  fields.reserve(trials.size());
  for (Trial& trial : trials) fields.push_back(std::move(trial.look.field));
  return fields;
}

}  // namespace plotscan::plots
