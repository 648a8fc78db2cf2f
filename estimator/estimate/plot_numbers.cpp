// SPDX-License-Identifier: Apache-2.0
#include "estimate/plot_numbers.h"

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "core/error.h"
#include "core/text.h"

namespace plotscan::estimate {
namespace {

// The place of a name among those that there are.
std::size_t place_among(const std::vector<std::string>& names, const char* what,
                        const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("{} is one of {}; not \"{}\"", what, joined(names, ", "), name));
  return static_cast<std::size_t>(found - names.begin());
}

// A plot's place along one of the grid's axes: its row, or its column.
using Place = int PlotEstimate::*;

Eigen::Vector2d direction_of(Corner corner) {
  const bool west = corner == Corner::sw || corner == Corner::nw;
  const bool south = corner == Corner::sw || corner == Corner::se;
  return {west ? -1 : 1, south ? -1 : 1};
}

int most(const std::vector<PlotEstimate>& plots, Place place) {
  int most = 0;
  for (const PlotEstimate& plot : plots) most = std::max(most, plot.*place);
  return most;
}

// The direction in which the places count up: the sum of the steps from plot to plot along this
// axis, each between two with the same place along the other.
Eigen::Vector2d counting_direction(const std::vector<PlotEstimate>& plots, Place place,
                                   Place other) {
  std::map<std::pair<int, int>, Eigen::Vector2d> centers;
  for (const PlotEstimate& plot : plots) centers[{plot.*other, plot.*place}] = plot.box.center;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (auto next = centers.begin(), at = next++; next != centers.end(); at = next++) {
    if (next->first.first == at->first.first) sum += (next->second - at->second).normalized();
  }
  return sum;
}

// Counts the places from the end of the axis that lies towards the corner.
void count_from(Corner corner, Place place, Place other, std::vector<PlotEstimate>& plots) {
  if (counting_direction(plots, place, other).dot(direction_of(corner)) <= 0) return;
  const int last = most(plots, place);
  for (PlotEstimate& plot : plots) plot.*place = last + 1 - plot.*place;
}

// Rows and columns as they are counted from the first corner.
void count_places(const NumberingOptions& options, std::vector<PlotEstimate>& plots) {
  for (const PlotEstimate& plot : plots) {
    if (plot.row < 1 || plot.column < 1)
      throw InputError("the plots have no rows and columns by which they could be numbered");
  }
  const Corner corner = options.first_corner.value_or(Corner::sw);
  count_from(corner, &PlotEstimate::row, &PlotEstimate::column, plots);
  count_from(corner, &PlotEstimate::column, &PlotEstimate::row, plots);
}

std::map<int, std::vector<PlotEstimate>> by_trial(const std::vector<PlotEstimate>& plots) {
  std::map<int, std::vector<PlotEstimate>> trials;
  for (const PlotEstimate& plot : plots) trials[plot.trial].push_back(plot);
  return trials;
}

void require_one_trial(const std::vector<PlotEstimate>& plots) {
  const std::size_t trials = by_trial(plots).size();
  if (trials > 1)
    throw InputError(fmt::format(
        "plots of {} trials were found, and one trial is named; give the part of the field that is "
        "named (--crop-box)",
        trials));
}

void require_same_shape(const NamedPlaces& places, const std::vector<PlotEstimate>& plots) {
  int rows = 0;
  int columns = 0;
  for (const auto& [place, plot] : places.plots) {
    rows = std::max(rows, place.first);
    columns = std::max(columns, place.second);
  }
  const int found_rows = most(plots, &PlotEstimate::row);
  const int found_columns = most(plots, &PlotEstimate::column);
  if (rows == found_rows && columns == found_columns) return;
  throw InputError(fmt::format(
      "the named plots have {} rows and {} columns, and plots in {} rows and {} columns "
      "were found; give their boxes (--boxes), or the part of the field that is named "
      "(--crop-box)",
      rows, columns, found_rows, found_columns));
}

}  // namespace

const std::vector<std::string>& corner_names() {
  static const std::vector<std::string> names = {"sw", "se", "nw", "ne"};
  return names;
}

const std::vector<std::string>& numbering_names() {
  static const std::vector<std::string> names = {"zigzag", "serpentine"};
  return names;
}

Corner corner_named(const std::string& name) {
  return static_cast<Corner>(place_among(corner_names(), "the first corner", name));
}

PlotNumbering numbering_named(const std::string& name) {
  return static_cast<PlotNumbering>(place_among(numbering_names(), "the numbering", name));
}

void number_plots(const NumberingOptions& options, Estimate& estimate) {
  const PlotNumbering numbering = options.numbering.value_or(PlotNumbering::rows);
  std::uint64_t first = options.first_number.value_or(1);
  std::map<std::uint64_t, PlotEstimate> by_number;
  for (auto& [trial, plots] : by_trial(estimate.plots)) {
    count_places(options, plots);
    const auto columns = static_cast<std::uint64_t>(most(plots, &PlotEstimate::column));
    for (PlotEstimate& plot : plots) {
      const auto row = static_cast<std::uint64_t>(plot.row - 1);
      const std::uint32_t place =
          column_at(numbering, row, static_cast<std::uint32_t>(plot.column - 1),
                    static_cast<std::uint32_t>(columns));
      const std::uint64_t number = first + row * columns + place;
      plot.id = number;
      by_number.emplace(number, std::move(plot));
    }
    first += static_cast<std::uint64_t>(most(plots, &PlotEstimate::row)) * columns;
  }
  check(by_number.size() == estimate.plots.size(), "two plots in one row and column");
  estimate.plots.clear();
  for (auto& [number, plot] : by_number) estimate.plots.push_back(std::move(plot));
}

void name_plots(const NumberingOptions& options, const NamedPlaces& places, Estimate& estimate) {
  if (estimate.plots.empty()) return;
  require_one_trial(estimate.plots);
  count_places(options, estimate.plots);
  require_same_shape(places, estimate.plots);
  std::map<std::pair<int, int>, NamedPlot> missing = places.plots;
  for (PlotEstimate& plot : estimate.plots) {
    const auto named = missing.find({plot.row, plot.column});
    if (named == missing.end()) {
      throw InputError(
          fmt::format("a plot was found in row {}, column {}, and no plot is named there", plot.row,
                      plot.column));
    }
    plot.id = named->second.id;
    plot.attributes = std::move(named->second.attributes);
    missing.erase(named);
  }
  std::ranges::sort(estimate.plots, [](const PlotEstimate& a, const PlotEstimate& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  estimate.id_property = places.id_property;
  GivenNames given{.plots = places.plots.size(), .id_property = places.id_property};
  for (const auto& [place, plot] : missing) given.not_found.push_back(plot.id);
  estimate.diagnostics.names = given;
}

}  // namespace plotscan::estimate
