// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/drill_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastGapOfSpacing = 0.2;  // by which a step between plots is wider
constexpr double kMostOthers = 0.34;        // of the groups: plots of which not all rows were seen

using Lines = std::vector<std::vector<double>>;

// Steps from row to row, up to `within`, and those from plot to plot, from `between` on.
struct Steps {
  double within = 0, between = 0;
  double spacing = 0;  // mean of those within
};

// The places where the sorted steps jump by the greatest factors, with enough steps on either side:
// between row steps and plot steps, or between plot steps and steps over missing plots. A few plots
// of many rows have few plot steps.
std::vector<Steps> steps_of(const Lines& middles) {
  constexpr std::size_t kTried = 4;
  std::vector<double> steps;
  for (const std::vector<double>& line : middles)
    for (std::size_t i = 1; i < line.size(); ++i) steps.push_back(line[i] - line[i - 1]);
  std::ranges::sort(steps);
  const std::size_t few = std::max<std::size_t>(1, steps.size() / (std::size_t{2} * kMostSownRows));
  std::vector<Steps> found;
  double sum = 0;
  for (std::size_t i = 0; i + few <= steps.size(); ++i) {
    if (i >= few && steps[i] > steps[i - 1])
      found.push_back(
          {.within = steps[i - 1], .between = steps[i], .spacing = sum / static_cast<double>(i)});
    sum += steps[i];
  }
  std::ranges::stable_sort(found, std::ranges::greater(),
                           [](const Steps& at) { return at.between / at.within; });
  found.resize(std::min(found.size(), kTried));
  return found;
}

double most_frequent(const std::vector<double>& values) {
  double most = 0;
  std::ptrdiff_t times = 0;
  for (const double value : values) {
    const auto count = std::ranges::count(values, value);
    if (count > times || (count == times && value > most)) {
      times = count;
      most = value;
    }
  }
  return most;
}

// First and last row of each group between wider steps.
using Groups = std::vector<std::pair<std::size_t, std::size_t>>;

Groups groups_of(const std::vector<double>& line, double widest_step) {
  Groups groups;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= line.size(); ++i) {
    if (i < line.size() && line[i] - line[i - 1] <= widest_step) continue;
    groups.emplace_back(first, i - 1);
    first = i;
  }
  return groups;
}

struct Grouped {
  DrilledPlots plots;
  double others = 1;  // share of the groups that are no whole plot
  double odd = 0;     // such groups, and steps within a group that are wider than one spacing
};

// Steps within a group that are as wide as those between plots would be: these groups hold several
// plots, between two alleys.
double wide_steps(const std::vector<double>& line, const Steps& steps) {
  double wide = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = line[i] - line[i - 1];
    wide += step <= steps.within && step > (1 + kLeastGapOfSpacing) * steps.spacing ? 1 : 0;
  }
  return wide;
}

// The rows in groups between wider steps.
std::optional<Grouped> grouped(const Lines& middles, const Steps& steps) {
  std::vector<Groups> groups;
  std::vector<double> sizes;
  for (const std::vector<double>& line : middles) {
    groups.push_back(groups_of(line, steps.within));
    for (const auto& [first, last] : groups.back())
      sizes.push_back(static_cast<double>(last - first + 1));
  }
  DrilledPlots plots{.rows = static_cast<int>(most_frequent(sizes)), .spacing = steps.spacing};
  if (plots.rows < 2 || plots.rows > kMostSownRows) return std::nullopt;
  const double span = (plots.rows - 1) * steps.spacing;
  double all = 0, whole = 0, length = 0, wide = 0;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const std::vector<double>& line = middles[i];
    plots.begins.emplace_back();
    wide += wide_steps(line, steps);
    for (const auto& [first, last] : groups[i]) {
      ++all;
      const double found = line[last] - line[first];
      if (std::abs(found - span) > 0.3 * steps.spacing) continue;
      ++whole;
      length += found;
      plots.begins.back().push_back(0.5 * (line[first] + line[last]));
    }
  }
  if (whole == 0) return std::nullopt;
  plots.spacing = length / (whole * (plots.rows - 1));
  return Grouped{.plots = std::move(plots), .others = 1 - whole / all, .odd = all - whole + wide};
}

}  // namespace

std::optional<DrilledPlots> drilled_plots(const Lines& middles, double most_spacing,
                                          double least_gap) {
  std::optional<Grouped> best;
  for (const Steps& steps : steps_of(middles)) {
    // Leaves move the rows that are seen towards the gap: half of it must be left.
    const double least_break =
        steps.spacing + 0.5 * std::max(least_gap, kLeastGapOfSpacing * steps.spacing);
    if (steps.spacing > most_spacing || steps.between < least_break) continue;
    std::optional<Grouped> rows = grouped(middles, steps);
    if (!rows || rows->others > kMostOthers) continue;
    if (!best || rows->odd < best->odd) best = std::move(rows);
  }
  if (!best) return std::nullopt;
  DrilledPlots plots = std::move(best->plots);
  for (std::vector<double>& line : plots.begins) {
    fill_in(line);
    for (double& begin : line) begin -= plots.width() / 2;
  }
  return plots;
}

}  // namespace plotscan::plots
