// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/plot_box.h"
#include "core/trial_layout.h"
#include "core/yaml_section.h"
#include "description/internal/sections.h"
#include "planting/plot_layout.h"

namespace plotscan::description {
namespace {

constexpr Range kPlotSize = {0.05, 1000};
constexpr Range kGap = {0, 1000};
constexpr Range kPitch = {-10000, 10000};
constexpr Range kPlace = {-100000, 100000};
constexpr Range kSkew = {-45, 45};
constexpr std::size_t kMostRows = 10'000;
constexpr std::int64_t kLargestFirstNumber = 1'000'000'000;

Eigen::Vector2d vector_at(const YamlSection& section, const std::string& key, Range range) {
  const auto [x, y] = section.pair(key, range);
  return {x, y};
}

void read_rows(const YamlSection& section, planting::PlotGridDescription& grid) {
  for (const YamlSection& row : section.list("rows", kMostRows)) {
    const auto plots = static_cast<std::uint32_t>(row.integer("plots", 1, kMostPlots));
    grid.rows.push_back({plots, row.number("offset_m", kPlace, 0.0)});
  }
  if (planting::plots_of(grid) > kMostPlots) {
    section.fail("rows", "hold {} plots; at most {} are allowed", planting::plots_of(grid),
                 kMostPlots);
  }
}

void read_pitch(const YamlSection& section, planting::PlotGridDescription& grid) {
  for (const char* key : {"gap_width_m", "gap_length_m", "heading_deg", "skew_deg"})
    if (section.has(key)) section.fail("pitch", "takes the place of {}", key);
  const YamlSection pitch = section.section("pitch");
  grid.pitch = {vector_at(pitch, "column_m", kPitch), vector_at(pitch, "row_m", kPitch)};
  const auto& [column, row] = *grid.pitch;
  if (std::abs(plane_cross(column, row)) <=
      column.norm() * row.norm() * std::cos(kSkew.high * kDegrees))
    section.fail("pitch", "has steps less than 45 degrees apart, or none");
}

void read_alleys(const YamlSection& section, planting::PlotGridDescription& grid) {
  const std::int64_t rows = static_cast<std::int64_t>(grid.rows.size());
  for (const YamlSection& alley : section.list("alleys", kMostPlots)) {
    if (alley.has("after_row") == alley.has("after_column"))
      alley.fail("after_row", "or after_column has to be given, one of the two");
    const bool is_row = alley.has("after_row");
    const char* key = is_row ? "after_row" : "after_column";
    const std::int64_t last = (is_row ? rows : planting::columns_of(grid)) - 1;
    if (last < 1) alley.fail(key, "has no place: there is only one");
    const auto after = static_cast<std::uint32_t>(alley.integer(key, 1, last));
    auto& alleys = is_row ? grid.row_alleys_m : grid.column_alleys_m;
    if (!alleys.emplace(after, alley.number("width_m", kGap)).second)
      alley.fail(key, "{} has an alley already", after);
  }
}

void read_missing(const YamlSection& section, planting::PlotGridDescription& grid) {
  const std::int64_t first = grid.first_number;
  const std::int64_t last = first + static_cast<std::int64_t>(planting::plots_of(grid)) - 1;
  if (section.has("missing")) {
    for (const YamlSection& entry : section.list("missing", kMostPlots, "number"))
      grid.missing.push_back(static_cast<std::uint32_t>(entry.integer("number", first, last)));
    std::sort(grid.missing.begin(), grid.missing.end());
    const auto twice = std::adjacent_find(grid.missing.begin(), grid.missing.end());
    if (twice != grid.missing.end()) section.fail("missing", "names plot {} twice", *twice);
    if (grid.missing.size() == planting::plots_of(grid)) section.fail("missing", "leaves no plot");
  }
  grid.missing_rate = section.number("missing_rate", {0, 1}, 0.0);
}

// Plots that lean against each other stay apart only when the steps are long enough.
void require_plots_apart(const YamlSection& section, const planting::PlotGridDescription& grid) {
  const double column_step =
      grid.pitch ? grid.pitch->column_m.norm() : grid.width_m + grid.gap_width_m;
  const double row_step = grid.pitch ? grid.pitch->row_m.norm() : grid.length_m + grid.gap_length_m;
  const double cosine = grid.pitch
                            ? std::abs(plane_cross(grid.pitch->column_m, grid.pitch->row_m)) /
                                  (column_step * row_step)
                            : std::cos(grid.skew_rad);
  constexpr double kRounding = 1e-9;
  const auto overlap = [&](double step, double size, const char* what) {
    if (step + kRounding >= size) return;
    section.fail(grid.pitch ? "pitch" : "skew_deg",
                 "makes neighbours overlap: {:.3f} m apart and {:.3f} m {}", step, size, what);
  };
  overlap(column_step * cosine, grid.width_m, "wide");
  overlap(row_step, grid.length_m, "long");
  for (const auto& [column, alley_m] : grid.column_alleys_m)
    overlap((grid.width_m + alley_m) * cosine, grid.width_m, "wide, at an alley");
  // Where the axes are perpendicular, rows that keep apart do so however they are shifted.
  if (cosine > 1 - kRounding) return;
  if (const auto pair = planting::overlapping_plots(planting::grid_plots(grid))) {
    section.fail(grid.pitch ? "pitch" : "skew_deg",
                 "makes plots {} and {} overlap, which are in different rows", pair->first,
                 pair->second);
  }
}

}  // namespace

planting::PlotGridDescription read_plot_grid(const YamlSection& section,
                                             std::uint32_t first_number) {
  planting::PlotGridDescription grid;
  grid.width_m = section.number("width_m", kPlotSize);
  grid.length_m = section.number("length_m", kPlotSize);
  grid.gap_width_m = section.number("gap_width_m", kGap, 0.0);
  grid.gap_length_m = section.number("gap_length_m", kGap, 0.0);
  grid.random_heading = section.text("heading_deg", "0") == "random";
  if (!grid.random_heading)
    grid.heading_rad = section.number("heading_deg", {-360, 360}, 0.0) * kDegrees;
  grid.skew_rad = section.number("skew_deg", kSkew, 0.0) * kDegrees;
  const auto [x, y] = section.pair("position_m", kPlace, std::pair{0.0, 0.0});
  grid.position_m = {x, y};
  read_rows(section, grid);
  if (section.has("pitch")) read_pitch(section, grid);
  if (section.has("alleys")) read_alleys(section, grid);
  if (section.choice("numbering", {"rows", "serpentine"}, 0) == 1)
    grid.numbering = PlotNumbering::serpentine;
  grid.first_number = static_cast<std::uint32_t>(
      section.integer("first_number", 1, kLargestFirstNumber, first_number));
  require_plots_apart(section, grid);
  read_missing(section, grid);
  return grid;
}

}  // namespace plotscan::description
