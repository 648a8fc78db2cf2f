// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/touching_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/statistics.h"

namespace plotscan::plots {
namespace {

// All chosen.
constexpr double kWidestBetweenRows_m = 0.8;  // without leaves: maize, rows 40 in apart
constexpr double kLeavesOfRow_m = 0.2;        // with leaves
constexpr double kNarrowest_m = 0.3;          // plot: leaves of one cover a narrower next one
constexpr double kLeastStanding = 0.25;       // of the fullest plot's canopy: less is bare
// Of a plot, by which a stretch may be shorter than plots end to end, or longer, as leaves hang
// over and plants lie down; where they do, the longest stretch is longer by as much.
constexpr double kMostShorter = 0.2, kMostLonger = 0.3;

// Where canopy begins and ends, in cells.
struct Stretch {
  int begin = 0, end = 0;
  double bare = 0;  // width of the bare ground between two rows

  // Half of the way from row to row lies beyond the outer rows, as bare as that between two.
  double length() const { return end - begin + bare; }
};

// Stretches of canopy, in which rows leave no more than `most_between` cells bare; none where all
// of the profile is one, which then shows neither where it begins nor where it ends.
std::vector<Stretch> stretches_of(const ProfileSums& profile, double least, int most_between) {
  std::vector<Stretch> stretches;
  std::vector<std::vector<double>> bare;
  for (int cell = 0; cell < profile.cells(); ++cell) {
    if (profile.mean(cell, cell + 1) <= least) continue;
    if (stretches.empty() || cell - stretches.back().end > most_between) {
      stretches.push_back({.begin = cell, .end = cell});
      bare.emplace_back();
    }
    if (cell > stretches.back().end) bare.back().push_back(cell - stretches.back().end);
    stretches.back().end = cell + 1;
  }
  if (!stretches.empty() && stretches.front().begin == 0 &&
      stretches.front().end == profile.cells())
    return {};
  for (std::size_t i = 0; i < stretches.size(); ++i)
    if (!bare[i].empty()) stretches[i].bare = quantile(std::move(bare[i]), 0.5);
  return stretches;
}

// Half-way between two rows stand the leaves of both, at the border of what is sown those of the
// outer one alone: half as many. The stretch between such places.
Stretch without_overhang(const ProfileSums& profile, Stretch stretch, int plot) {
  const int inner = std::min(plot / 2, (stretch.end - stretch.begin) / 4);
  std::vector<double> levels;
  for (int cell = stretch.begin + inner; cell < stretch.end - inner; ++cell)
    levels.push_back(profile.mean(cell, cell + 1));
  constexpr double kBetweenRows = 0.1;  // of the cells
  const double least = 0.5 * quantile(std::move(levels), kBetweenRows);
  while (profile.mean(stretch.begin, stretch.begin + 1) < least) ++stretch.begin;
  while (profile.mean(stretch.end - 1, stretch.end) < least) --stretch.end;
  return stretch;
}

// How many plots a stretch holds.
double plots_in(const Stretch& stretch, double side) {
  return std::floor(stretch.length() / side + kMostShorter);
}

// By how much a stretch is longer than its plots, as a share of one.
double longer_by(const Stretch& stretch, double side) {
  return stretch.length() / side - plots_in(stretch, side);
}

// Those that are about as long as plots end to end.
std::vector<Stretch> of_plots(std::vector<Stretch> stretches, double side) {
  if (stretches.empty()) return stretches;
  const Stretch& longest = *std::ranges::max_element(stretches, {}, &Stretch::length);
  const double most = kMostLonger + std::max(0.0, longer_by(longest, side));
  std::erase_if(stretches, [&](const Stretch& stretch) { return longer_by(stretch, side) > most; });
  return stretches;
}

double side_of_count(const std::vector<Stretch>& stretches, int count) {
  double length = 0;
  for (const Stretch& stretch : stretches) length += stretch.length();
  return length / count;
}

std::vector<double> cut(const std::vector<Stretch>& stretches, double side) {
  std::vector<double> begins;
  for (const Stretch& stretch : stretches) {
    const double plots = plots_in(stretch, side);
    const double first = 0.5 * (stretch.begin + stretch.end - plots * side);
    for (int k = 0; k < static_cast<int>(plots); ++k) begins.push_back(first + k * side);
  }
  return begins;
}

}  // namespace

std::optional<TouchingPlots> touching_plots(std::span<const ProfileSums> profiles, double cell_m,
                                            std::optional<double> side_m,
                                            std::optional<int> count) {
  if (!side_m && (!count || profiles.size() != 1)) return std::nullopt;
  const auto cells = [&](double length_m) {
    return static_cast<int>(std::lround(length_m / cell_m));
  };
  const double row_m = std::min(kWidestBetweenRows_m, side_m.value_or(1) - kLeavesOfRow_m);
  TouchingPlots plots{.side = side_m.value_or(0) / cell_m};
  std::size_t most = 0;
  for (const ProfileSums& profile : profiles) {
    const int plot = cells(side_m.value_or(1));
    std::vector<Stretch> stretches =
        stretches_of(profile, kLeastStanding * profile.highest_mean(plot), cells(row_m));
    for (Stretch& stretch : stretches) stretch = without_overhang(profile, stretch, plot);
    if (!side_m) plots.side = side_of_count(stretches, *count);
    if (plots.side * cell_m < kNarrowest_m) return std::nullopt;
    plots.begins.push_back(cut(of_plots(std::move(stretches), plots.side), plots.side));
    most = std::max(most, plots.begins.back().size());
  }
  const bool as_told = !count || most == static_cast<std::size_t>(*count);
  return most > 0 && as_told ? std::optional(plots) : std::nullopt;
}

}  // namespace plotscan::plots
