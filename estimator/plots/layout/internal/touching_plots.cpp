// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/touching_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plotscan::plots {
namespace {

// All chosen.
constexpr double kWidestBetweenRows_m = 0.8;  // without leaves: maize, rows 40 in apart
constexpr double kLeavesOfRow_m = 0.2;        // with leaves
constexpr double kNarrowest_m = 0.3;          // plot: leaves of one cover a narrower next one
constexpr double kLeastStanding = 0.25;       // of the fullest plot's canopy: less is bare
// Of a plot, by which a stretch may be longer than plots end to end, as leaves hang over, or
// shorter, as the outer rows lie within: half the way between two rows on either side.
constexpr double kMostLonger = 0.3, kMostShorter = 0.45;

// Where canopy begins and ends, in cells.
struct Stretch {
  int begin = 0, end = 0;
  double length() const { return end - begin; }
};

double fullest(const ProfileSums& profile, int size) {
  double most = 0;
  for (int i = 0; i + size <= profile.cells(); ++i)
    most = std::max(most, profile.mean(i, i + size));
  return most;
}

// Stretches of canopy, in which rows leave no more than `most_between` cells bare.
std::vector<Stretch> stretches_of(const ProfileSums& profile, int plot, int most_between) {
  const double least = kLeastStanding * fullest(profile, plot);
  std::vector<Stretch> stretches;
  for (int cell = 0; cell < profile.cells(); ++cell) {
    if (profile.mean(cell, cell + 1) <= least) continue;
    if (stretches.empty() || cell - stretches.back().end > most_between)
      stretches.push_back({.begin = cell, .end = cell});
    stretches.back().end = cell + 1;
  }
  return stretches;
}

// How many plots a stretch holds; none if it is longer or shorter than any number of them.
double plots_in(const Stretch& stretch, double side) {
  const double sides = stretch.length() / side;
  const double plots = std::floor(sides + kMostShorter);
  return sides - plots <= kMostLonger ? plots : 0;
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
    const std::vector<Stretch> stretches =
        stretches_of(profile, cells(side_m.value_or(1)), cells(row_m));
    if (!side_m) plots.side = side_of_count(stretches, *count);
    if (plots.side * cell_m < kNarrowest_m) return std::nullopt;
    plots.begins.push_back(cut(stretches, plots.side));
    most = std::max(most, plots.begins.back().size());
  }
  const bool as_told = !count || most == static_cast<std::size_t>(*count);
  return most > 0 && as_told ? std::optional(plots) : std::nullopt;
}

}  // namespace plotscan::plots
