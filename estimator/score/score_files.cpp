// SPDX-License-Identifier: Apache-2.0
#include "score/score_files.h"

#include <algorithm>
#include <set>

#include "core/angle.h"
#include "core/csv.h"
#include "core/list_of.h"
#include "core/place_json.h"
#include "core/statistics.h"
#include "core/text.h"
#include "core/text_file.h"
#include "estimate/height_properties.h"

namespace plotscan::score {
namespace {

using nlohmann::json;

json error_json(const estimate::HeightError& error) {
  return {{"standard_error_m", error.standard_error_m},
          {"low95_m", error.low95_m},
          {"high95_m", error.high95_m}};
}

// What the estimate says of its own trust; a method that says nothing leaves no member.
void add_trust(json& document, const FoundPlot& found) {
  for (const auto& [name, error] : found.errors) document["errors"][name] = error_json(error);
  if (found.confidence) document["confidence"] = *found.confidence;
  if (!found.flags.empty()) document["flags"] = found.flags;
}

void read_trust(const json& document, FoundPlot& found) {
  if (document.contains("errors")) {
    for (const auto& [name, error] : document["errors"].items()) {
      const json& standard = error.at("standard_error_m");  // null: an interval alone
      found.errors[name] = {.standard_error_m = standard.is_null() ? kNaN : standard.get<double>(),
                            .low95_m = error.at("low95_m"),
                            .high95_m = error.at("high95_m")};
    }
  }
  if (document.contains("confidence")) found.confidence = document["confidence"].get<double>();
  if (document.contains("flags")) found.flags = document["flags"].get<std::vector<std::string>>();
}

json plot_json(const PlotScore& plot) {
  json document = {{"plot_number", plot.truth.id},     {"row_number", plot.truth.row},
                   {"col_number", plot.truth.column},  {"box", box_json(plot.truth.box)},
                   {"truths_m", plot.truth.heights_m}, {"found", nullptr}};
  if (plot.truth.trial > 0) document["trial_number"] = plot.truth.trial;
  if (plot.found) {
    document["found"] = {{"estimate", plot.found->estimate},
                         {"iou", plot.found->iou},
                         {"center_error_m", plot.found->center_error_m},
                         {"heading_error_deg", plot.found->heading_error_rad / kDegrees},
                         {"heights_m", plot.found->heights_m}};
    add_trust(document["found"], *plot.found);
  }
  return document;
}

PlotScore plot_from_json(const json& document) {
  PlotScore plot{.truth = {.id = document.at("plot_number"),
                           .trial = document.value("trial_number", 0),
                           .row = document.at("row_number"),
                           .column = document.at("col_number"),
                           .box = box_from(document.at("box")),
                           .heights_m = document.at("truths_m")},
                 .found = {}};
  const json& found = document.at("found");
  if (found.is_null()) return plot;
  plot.found = {.estimate = found.at("estimate"),
                .iou = found.at("iou"),
                .center_error_m = found.at("center_error_m"),
                .heading_error_rad = found.at("heading_error_deg").get<double>() * kDegrees,
                .heights_m = found.at("heights_m")};
  read_trust(found, *plot.found);
  return plot;
}

std::string height_at(const std::map<std::string, double>& heights_m, const std::string& name) {
  const auto found = heights_m.find(name);
  return found == heights_m.end() ? "" : format_number(found->second);
}

std::set<std::string> heights_with_intervals(const FieldScore& field) {
  std::set<std::string> names;
  for (const PlotScore& plot : field.plots) {
    if (!plot.found) continue;
    for (const auto& [name, error] : plot.found->errors) names.insert(name);
  }
  return names;
}

// The ends of the intervals, the confidence and the flags, these with semicolons between them.
void write_trust(TextFile& out, const PlotScore& plot, const std::set<std::string>& intervals) {
  const FoundPlot found = plot.found.value_or(FoundPlot{});
  for (const std::string& height : intervals) {
    const auto error = found.errors.find(height);
    if (error == found.errors.end()) {
      out << ",,";
    } else {
      out << "," << error->second.low95_m << "," << error->second.high95_m;
    }
  }
  out << "," << (found.confidence ? format_number(*found.confidence) : "") << ","
      << csv_field(joined(found.flags, ";"));
}

}  // namespace

void to_json(json& document, const BoxScore& boxes) {
  document = {{"plots", boxes.plots},
              {"found", boxes.found},
              {"missed", boxes.missed},
              {"extra", boxes.extra},
              {"recall", boxes.recall},
              {"precision", boxes.precision},
              {"iou_mean", boxes.iou_mean},
              {"iou_median", boxes.iou_median},
              {"iou_min", boxes.iou_min},
              {"center_rmse_m", boxes.center_rmse_m},
              {"heading_rmse_deg", boxes.heading_rmse_rad / kDegrees}};
}

void to_json(json& document, const TrialScore& trial) {
  document = {{"trial_number", trial.trial},
              {"plots", trial.plots},
              {"found", trial.found},
              {"heights", trial.heights}};
}

void to_json(json& document, const FieldScore& field) {
  document = {
      {"method", field.method}, {"extra", field.extra}, {"plots", list_of(field.plots, plot_json)}};
}

void from_json(const json& document, FieldScore& field) {
  field = {.method = document.at("method"),
           .plots = list_of(document.at("plots"), plot_from_json),
           .extra = document.at("extra")};
}

void write_plot_table(const std::filesystem::path& path, const FieldScore& field) {
  const std::set<std::string> heights = estimated_heights(field);
  const std::set<std::string> truths = true_heights(field);
  const std::set<std::string> intervals = heights_with_intervals(field);
  const bool several_trials =
      std::ranges::any_of(field.plots, [](const PlotScore& plot) { return plot.truth.trial > 0; });
  TextFile out(path);
  out << "plot_number," << (several_trials ? "trial_number," : "")
      << "row_number,col_number,found,estimate,iou,center_error_m,heading_error_deg";
  for (const std::string& truth : truths) out << "," << csv_field("true_" + truth);
  for (const std::string& height : heights)
    out << "," << csv_field(estimate::property_of(height, "estimated_"));
  for (const std::string& height : intervals)
    out << "," << csv_field(estimate::property_of(height, estimate::kLow)) << ","
        << csv_field(estimate::property_of(height, estimate::kHigh));
  if (!intervals.empty()) out << ",confidence,flags";
  out << "\n";
  for (const PlotScore& plot : field.plots) {
    out << csv_field(plot.truth.id.text()) << ",";
    if (several_trials) out << plot.truth.trial << ",";
    out << plot.truth.row << "," << plot.truth.column << ",";
    if (plot.found) {
      out << "1," << csv_field(plot.found->estimate.text()) << "," << plot.found->iou << ","
          << plot.found->center_error_m << "," << plot.found->heading_error_rad / kDegrees;
    } else {
      out << "0,,,,";
    }
    for (const std::string& truth : truths) out << "," << height_at(plot.truth.heights_m, truth);
    for (const std::string& height : heights)
      out << "," << (plot.found ? height_at(plot.found->heights_m, height) : "");
    if (!intervals.empty()) write_trust(out, plot, intervals);
    out << "\n";
  }
  out.close();
}

}  // namespace plotscan::score
