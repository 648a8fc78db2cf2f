// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/trials_beside.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "core/angle.h"
#include "core/plot_box.h"
#include "core/random.h"
#include "plots/search/internal/canopy_parts.h"
#include "plots/search/internal/trial_area.h"
#include "plots/signs/field_signs.h"

namespace plotscan::plots {
namespace {

using Trials = std::vector<SeenTrial>;

constexpr std::size_t kMostTrials = 6;
constexpr int kMostRounds = 3;
constexpr std::size_t kMostStarts = 3;
constexpr double kAlike = 0.15;       // sizes that differ by less
constexpr double kEnoughPerM2 = 400;  // points, to tell trials apart
// Confidence of the first trial's plots, whatever stands beside them: 1 on 27 fields of trials of
// three generators and 0.62 on one; 0.26 and less of bushes, trees and houses (8 fields).
constexpr double kLeastOfFirst = 0.3;

// About `per_m2` points a square metre. Which ones depends on each point alone, not on their order.
std::vector<Eigen::Vector3f> thinned(std::span<const Eigen::Vector3f> points, double per_m2) {
  const Eigen::AlignedBox2f extent = extent_of_finite(points);
  std::vector<Eigen::Vector3f> kept;
  if (extent.isEmpty()) return kept;
  const double share = per_m2 * extent.volume() / static_cast<double>(points.size());
  std::ranges::copy_if(points, std::back_inserter(kept), [&](const Eigen::Vector3f& point) {
    const std::uint64_t x = std::bit_cast<std::uint32_t>(point.x());
    const std::uint64_t y = std::bit_cast<std::uint32_t>(point.y());
    return RandomStream(0, random_purpose("plots/thinned"), x << 32 | y).uniform() < share;
  });
  return kept;
}

// The points of the field without the trials, but for those that are kept.
std::vector<Eigen::Vector3f> rest_of(const ScannedField& field, const Trials& trials,
                                     const std::vector<const SeenTrial*>& kept = {}) {
  std::vector<PlotBox> areas;
  for (const SeenTrial& trial : trials)
    if (std::ranges::find(kept, &trial) == kept.end())
      areas.insert(areas.end(), trial.area.begin(), trial.area.end());
  return points_outside(field.points, areas);
}

// What is seen of the same field in some of its points.
template <typename See>
auto seen_in(const ScannedField& field, std::span<const Eigen::Vector3f> points, const See& see) {
  const FieldBlocks blocks(points, field.noise_m, field.threads);
  return see(
      ScannedField{points, blocks, field.noise_m, field.hints, field.threads, field.ground_error});
}

// What shows beside the trials, whatever else stands there.
Look look_beside(const ScannedField& field, const Trials& trials) {
  return seen_in(field, rest_of(field, trials), look_once);
}

// What shows where some of the trials stand, with all others taken away.
Look look_at(const ScannedField& field, const Trials& trials,
             const std::vector<const SeenTrial*>& some) {
  return seen_in(field, rest_of(field, trials, some), look_twice);
}

// Adds one trial after the other, each in what the ones before leave of the canopy. It need not
// convince yet, as those that are still to come disturb its picture.
void propose(const ScannedField& field, Look look, Trials& trials) {
  while (look.may_be >= kLeastOfTrial && trials.size() < kMostTrials) {
    trials.push_back({.area = area_of(look.field.fit->layout)});
    look = look_beside(field, trials);
  }
}

// Whether a look shows a trial. A single line of plots between which gaps are nearly as full may be
// a hedge.
bool is_trial(const Look& look) {
  constexpr double kMostBetween = 0.8;  // cover of gaps, of the plots'
  if (look.field.plots.size() < kLeastOfTrial) return false;
  const TrialLayout& layout = look.field.fit->layout;
  const bool is_line = layout.rows() == 1 || layout.columns() == 1;
  return !is_line || look.field.signs->gap_cover < kMostBetween;
}

// Looks at a trial with the others taken away. Whether it is a field of plots then.
bool is_confirmed(const ScannedField& field, const Trials& trials, SeenTrial& trial) {
  trial.look = look_at(field, trials, {&trial});
  if (!is_trial(trial.look)) return false;
  trial.area = area_of(trial.look.field.fit->layout);
  return true;
}

void drop_unconfirmed(const ScannedField& field, Trials& trials) {
  for (std::size_t i = 0; i < trials.size();) {
    if (is_confirmed(field, trials, trials[i]))
      ++i;
    else
      trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// Those that stay when all others are taken away; none where that does not come to an end.
Trials confirmed(const ScannedField& field, Trials trials) {
  for (int round = 0; round < kMostRounds && trials.size() > 1; ++round) {
    const std::size_t before = trials.size();
    drop_unconfirmed(field, trials);
    if (trials.size() == before) return trials;
  }
  return {};
}

// The trials of which the look is the first. Once some are confirmed, it shows more clearly where
// further ones lie.
Trials told_apart(const ScannedField& field, const Look& first) {
  Trials trials;
  propose(field, first, trials);
  if (trials.size() < 2) return {};
  drop_unconfirmed(field, trials);
  if (trials.empty()) return {};
  propose(field, look_beside(field, trials), trials);
  return confirmed(field, std::move(trials));
}

bool are_alike(double a, double b) { return std::abs(a - b) <= kAlike * std::max(a, b); }

// Whether plots of two layouts may be of one.
bool are_alike(const TrialLayout& a, const TrialLayout& b) {
  constexpr double kSameHeading_rad = 5 * kDegrees;
  const double turned = std::remainder(a.heading_rad() - b.heading_rad(), kPi);
  return are_alike(a.width_m, b.width_m) && are_alike(a.length_m, b.length_m) &&
         std::abs(turned) < kSameHeading_rad;
}

// Whether most plots of one begin where a plot of the other ends: between trials ground is seen.
bool follow(const PlotField& one, const PlotField& other) {
  constexpr double kSeen_m = 0.3;  // less is closed by leaves
  const auto follows_another = [&](const FoundPlot& plot) {
    PlotBox around = plot.box;
    around.length_m += 2 * kSeen_m;
    around.width_m += 2 * kSeen_m;
    return std::ranges::any_of(other.plots, [&](const FoundPlot& beside) {
      return intersection_area(around, beside.box) > 0;
    });
  };
  return 2 * std::ranges::count_if(one.plots, follows_another) > std::ssize(one.plots);
}

// Two trials of like plots as one, if as many plots are found so.
std::optional<SeenTrial> one_of_both(const ScannedField& field, const Trials& trials,
                                     const SeenTrial& a, const SeenTrial& b) {
  if (!are_alike(a.look.field.fit->layout, b.look.field.fit->layout)) return {};
  Look look = look_at(field, trials, {&a, &b});
  if (expected_plots(look) < expected_plots(a.look) + expected_plots(b.look)) return {};
  std::vector<PlotBox> area = area_of(look.field.fit->layout);
  return SeenTrial{.area = std::move(area), .look = std::move(look)};
}

// What two trials are together: one, or none where they are pieces of rows that run on from one to
// the other, or both.
Trials joined_or_dropped(const ScannedField& field, const Trials& trials, const SeenTrial& a,
                         const SeenTrial& b) {
  if (auto one = one_of_both(field, trials, a, b)) return {std::move(*one)};
  const bool run_on = follow(a.look.field, b.look.field) && follow(b.look.field, a.look.field);
  return run_on ? Trials{} : Trials{a, b};
}

// Whether the plots are as many as the other look's, and of the same size.
bool shows_those(const Look& look, const Look& other) {
  return look.field.plots.size() >= other.field.plots.size() &&
         are_alike(look.field.fit->layout, other.field.fit->layout);
}

// The trials, with those that are parts of one put together.
Trials as_one(const ScannedField& field, Trials trials) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (std::size_t k = i + 1; k < trials.size(); ++k) {
      const Trials together = joined_or_dropped(field, trials, trials[i], trials[k]);
      if (together.size() == 2) continue;
      trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(k));
      if (together.empty())
        trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(i));
      else
        trials[i] = together.front();
      k = i;
    }
  }
  return trials;
}

bool is_same(const Look& a, const Look& b) {
  const TrialLayout &one = a.field.fit->layout, &other = b.field.fit->layout;
  return one.places.size() == other.places.size() && are_alike(one.width_m, other.width_m) &&
         are_alike(one.length_m, other.length_m);
}

// The looks that may show a first trial, the clearest first.
std::vector<Look> starts_of(const Looks& looks) {
  std::vector<Look> all = looks.at_all;
  std::ranges::stable_sort(all, std::greater(), &Look::evidence);
  all.insert(all.begin(), looks.best);
  std::vector<Look> starts;
  for (const Look& look : all) {
    if (look.may_be < kLeastOfTrial || starts.size() == kMostStarts) continue;
    if (std::ranges::none_of(starts, [&](const Look& start) { return is_same(start, look); }))
      starts.push_back(look);
  }
  return starts;
}

// Whether one of the looks shows a trial clearly. Others beside it hide little of its shape.
bool show_a_trial(const std::vector<Look>& starts) {
  return std::ranges::any_of(starts, [](const Look& start) {
    return confidence_beside_others(*start.field.signs) > kLeastOfFirst;
  });
}

// The trials looked at in all points of the field, where these show the same plots. (Thinned clouds
// show gaps that some dense ones hide.)
Trials looked_at_closely(const ScannedField& field, Trials trials) {
  for (SeenTrial& trial : trials) {
    Look look = look_at(field, trials, {&trial});
    if (!shows_those(look, trial.look)) continue;
    trial.area = area_of(look.field.fit->layout);
    trial.look = std::move(look);
  }
  return trials;
}

// Whether a look shows one of the trials. From there these would be found once more.
bool shows_one_of(const Trials& trials, const Look& look) {
  return std::ranges::any_of(trials, [&](const SeenTrial& trial) {
    return are_alike(trial.look.field.fit->layout, look.field.fit->layout);
  });
}

// Whether no other trials can explain the field much better.
bool are_clear(const Trials& trials) {
  constexpr double kClear = 0.85;  // confidence of a field
  return trials.size() > 1 && std::ranges::all_of(trials, [](const SeenTrial& trial) {
           return trial.look.explained > kNearlyAll &&
                  field_confidence(*trial.look.field.signs) > kClear;
         });
}

// The trials of parts of the canopy, each looked at by itself.
Trials trials_of(const ScannedField& field, const CanopyParts& parts) {
  Trials trials;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    Look look = seen_in(field, parts.without_others(field.points, part), look_twice);
    if (!is_trial(look)) continue;
    std::vector<PlotBox> area = area_of(look.field.fit->layout);
    trials.push_back({.area = std::move(area), .look = std::move(look)});
  }
  return trials;
}

// The canopy in parts that lie apart, by wider paths first; not where they are so many that they
// are plots or shrubs.
std::vector<CanopyParts> parts_of(const ScannedField& field) {
  constexpr std::array kPaths_m = {3.0, 2.0, 1.5};
  constexpr std::size_t kMostParts = 12;
  std::vector<CanopyParts> all;
  std::size_t last = 1;
  for (const double path_m : kPaths_m) {
    CanopyParts parts(field.points, field.blocks.low_m(), path_m);
    if (parts.size() > kMostParts) break;
    if (parts.size() <= last) continue;
    last = parts.size();
    all.push_back(std::move(parts));
  }
  return all;
}

// Keeps the trials that explain a field better: two or more.
void keep_better(Trials trials, Trials& best) {
  if (trials.size() > 1 && expected_plots(trials) > expected_plots(best)) best = std::move(trials);
}

// The best trials of those that parts of the canopy show.
Trials best_of_parts(const ScannedField& field) {
  Trials best;
  for (const CanopyParts& parts : parts_of(field))
    if (!are_clear(best)) keep_better(as_one(field, trials_of(field, parts)), best);
  return best;
}

// The best trials of those of which a look is the first.
Trials best_of_starts(const ScannedField& field, const std::vector<Look>& starts) {
  Trials best;
  for (const Look& start : starts)
    if (!are_clear(best) && !shows_one_of(best, start))
      keep_better(as_one(field, told_apart(field, start)), best);
  return best;
}

}  // namespace

double expected_plots(const std::vector<SeenTrial>& trials) {
  double expected = 0;
  for (const SeenTrial& trial : trials) expected += expected_plots(trial.look);
  return expected;
}

std::vector<SeenTrial> trials_beside(const ScannedField& field, const Looks& looks) {
  const std::vector<Look> starts = starts_of(looks);
  if (!show_a_trial(starts)) return {};
  return seen_in(field, thinned(field.points, kEnoughPerM2), [&](const ScannedField& thin) {
    Trials best = best_of_parts(thin);
    if (!are_clear(best)) keep_better(best_of_starts(thin, starts), best);
    return looked_at_closely(field, std::move(best));
  });
}

}  // namespace plotscan::plots
