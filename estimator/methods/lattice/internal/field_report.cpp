// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/field_report.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "core/angle.h"

namespace plotscan::methods::lattice {
namespace {

using nlohmann::json;

constexpr std::size_t kMostListed = 6;  // of the places without a plot, for people

using RowAndColumn = std::pair<int, int>;

// The places of a field of plots where a row crosses a column and no plot was found; none where the
// columns do not run through all rows.
std::vector<RowAndColumn> places_without_plot(const plots::PlotField& field) {
  if (!field.why_none.empty() || !field.fit || !field.fit->columns_aligned) return {};
  const TrialLayout& layout = field.fit->layout;
  std::set<RowAndColumn> found;
  for (const TrialPlace& place : layout.places) found.emplace(place.row, place.column);
  std::vector<RowAndColumn> without;
  for (int row = 1; row <= layout.rows(); ++row)
    for (int column = 1; column <= layout.columns(); ++column)
      if (!found.contains({row, column})) without.emplace_back(row, column);
  return without;
}

std::string listed(const std::vector<RowAndColumn>& places) {
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), kMostListed); ++i)
    text +=
        fmt::format("{}row {} column {}", i == 0 ? "" : ", ", places[i].first, places[i].second);
  return places.size() > kMostListed ? text + ", ..." : text;
}

json fit_json(const plots::FieldFit& fit) {
  const TrialLayout& layout = fit.layout;
  const double row_heading = std::atan2(layout.row_axis.y(), layout.row_axis.x());
  json report = {{"heading_deg", degrees(layout.heading_rad())},
                 {"second_axis_deg", degrees(wrap_heading(row_heading))},
                 {"skew_deg", degrees(layout.skew_rad())},
                 {"width_m", layout.width_m},
                 {"length_m", layout.length_m},
                 {"rows", layout.rows()},
                 {"columns", layout.columns()},
                 {"row_pitch_m", layout.row_pitch_m},
                 {"column_pitch_m", layout.column_pitch_m},
                 {"columns_aligned", fit.columns_aligned},
                 {"rms_along_length_m", fit.rms_along_length_m},
                 {"rms_along_width_m", fit.rms_along_width_m},
                 {"leaf_spread_m", fit.leaf_spread_m},
                 {"side_contrast", fit.side_contrast}};
  if (fit.sown_rows) {
    report["drill_rows"] = fit.sown_rows->rows;
    report["drill_row_spacing_m"] = fit.sown_rows->spacing_m;
  }
  return report;
}

json null_if_unknown(double value) { return std::isnan(value) ? json() : json(value); }

json signs_json(const plots::FieldSigns& signs) {
  return {{"held_share", signs.held_share},
          {"filled_share", signs.filled_share},
          {"surface_share", signs.surface_share},
          {"squareness", signs.squareness},
          {"straightness", signs.straightness},
          {"aspect", signs.aspect},
          {"pitch_m", signs.pitch_m},
          {"passage", signs.passage},
          {"roughness", null_if_unknown(signs.roughness)},
          {"patch_scatter", null_if_unknown(signs.patch_scatter)},
          {"unevenness", signs.unevenness},
          {"mean_unevenness", signs.mean_unevenness},
          {"least_gap_m", signs.least_gap_m},
          {"gap_cover", signs.gap_cover},
          {"plots", signs.plots},
          {"evidence_per_plot", signs.evidence}};
}

std::string trial_line(const plots::PlotField& trial, std::size_t number) {
  const TrialLayout& layout = trial.fit->layout;
  std::string line = fmt::format(
      "trial {}    {} plots of {:.2f} x {:.2f} m, heading {:.2f} deg, {} rows, {} columns", number,
      trial.plots.size(), layout.width_m, layout.length_m, degrees(layout.heading_rad()),
      layout.rows(), layout.columns());
  if (const auto& sown = trial.fit->sown_rows)
    line += fmt::format(", sown in {} rows, {:.2f} m apart", sown->rows, sown->spacing_m);
  return line;
}

}  // namespace

json json_of(const plots::PlotField& field) {
  json report = field.fit ? fit_json(*field.fit) : json::object();
  if (const auto without = places_without_plot(field); !without.empty())
    report["places_without_plot"] = without;
  if (field.others_m2 > 0) report["others_m2"] = field.others_m2;
  if (field.signs) report["signs"] = signs_json(*field.signs);
  return report;
}

std::vector<std::string> lines_of(const plots::PlotField& field) {
  if (!field.why_none.empty() || !field.fit) return {};
  const TrialLayout& layout = field.fit->layout;
  std::vector<std::string> lines = {
      fmt::format("plot size  {:.2f} x {:.2f} m, heading {:.2f} deg", layout.width_m,
                  layout.length_m, degrees(layout.heading_rad())),
      fmt::format("lattice    {} rows, {} columns", layout.rows(), layout.columns())};
  if (const auto& sown = field.fit->sown_rows)
    lines.push_back(
        fmt::format("sown in    {} rows a plot, {:.2f} m apart", sown->rows, sown->spacing_m));
  if (const auto without = places_without_plot(field); !without.empty())
    lines.push_back(fmt::format("none found at {} of {} places: {}", without.size(),
                                layout.rows() * layout.columns(), listed(without)));
  if (field.others_m2 > 0)
    lines.push_back(fmt::format("left out   {:.0f} m2 of canopy without gaps beside the plots",
                                field.others_m2));
  return lines;
}

void report_trials(std::span<const plots::PlotField> trials, estimate::Diagnostics& diagnostics) {
  if (trials.size() == 1) {
    diagnostics.of_method["field"] = json_of(trials.front());
    diagnostics.lines = lines_of(trials.front());
    return;
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    diagnostics.of_method["trials"].push_back(json_of(trials[i]));
    diagnostics.lines.push_back(trial_line(trials[i], i + 1));
  }
}

}  // namespace plotscan::methods::lattice
