// SPDX-License-Identifier: Apache-2.0
#include "score/score_files.h"

#include <fstream>
#include <numbers>
#include <set>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::score {
namespace {

using nlohmann::json;

constexpr double kDegrees = std::numbers::pi / 180;

json to_json(const PlotBox& box) {
  return {{"center_x_m", box.center.x()},
          {"center_y_m", box.center.y()},
          {"width_m", box.width_m},
          {"length_m", box.length_m},
          {"heading_deg", box.heading_rad / kDegrees}};
}

PlotBox box_from_json(const json& document) {
  return {
      .center = {document.at("center_x_m").get<double>(), document.at("center_y_m").get<double>()},
      .width_m = document.at("width_m"),
      .length_m = document.at("length_m"),
      .heading_rad = document.at("heading_deg").get<double>() * kDegrees};
}

json to_json(const PlotScore& plot) {
  json document = {{"plot_number", plot.truth.id},     {"row_number", plot.truth.row},
                   {"col_number", plot.truth.column},  {"box", to_json(plot.truth.box)},
                   {"truths_m", plot.truth.heights_m}, {"found", nullptr}};
  if (plot.found) {
    document["found"] = {{"estimate", plot.found->estimate},
                         {"iou", plot.found->iou},
                         {"center_error_m", plot.found->center_error_m},
                         {"heading_error_deg", plot.found->heading_error_rad / kDegrees},
                         {"heights_m", plot.found->heights_m}};
  }
  return document;
}

PlotScore plot_from_json(const json& document) {
  PlotScore plot{.truth = {.id = document.at("plot_number"),
                           .row = document.at("row_number"),
                           .column = document.at("col_number"),
                           .box = box_from_json(document.at("box")),
                           .heights_m = document.at("truths_m")},
                 .found = {}};
  const json& found = document.at("found");
  if (found.is_null()) return plot;
  plot.found = {.estimate = found.at("estimate"),
                .iou = found.at("iou"),
                .center_error_m = found.at("center_error_m"),
                .heading_error_rad = found.at("heading_error_deg").get<double>() * kDegrees,
                .heights_m = found.at("heights_m")};
  return plot;
}

std::string height_at(const std::map<std::string, double>& heights_m, const std::string& name) {
  const auto found = heights_m.find(name);
  return found == heights_m.end() ? "" : format_number(found->second);
}

}  // namespace

json to_json(const BoxScore& boxes) {
  return {{"plots", boxes.plots},
          {"found", boxes.found},
          {"missed", boxes.missed},
          {"extra", boxes.extra},
          {"iou_median", boxes.iou_median},
          {"iou_min", boxes.iou_min},
          {"center_rmse_m", boxes.center_rmse_m},
          {"heading_rmse_deg", boxes.heading_rmse_rad / kDegrees}};
}

json to_json(const HeightScore& score) {
  return {{"height", score.height}, {"truth", score.truth},
          {"plots", score.plots},   {"without", score.without},
          {"rmse_m", score.rmse_m}, {"bias_m", score.bias_m},
          {"mae_m", score.mae_m},   {"standard_error_m", score.standard_error_m},
          {"r2", score.r2},         {"correlation2", score.correlation2}};
}

json to_json(const FieldScore& field) {
  json plots = json::array();
  for (const PlotScore& plot : field.plots) plots.push_back(to_json(plot));
  return {{"method", field.method}, {"extra", field.extra}, {"plots", plots}};
}

FieldScore field_from_json(const json& document) {
  FieldScore field{.method = document.at("method"), .plots = {}, .extra = document.at("extra")};
  for (const json& plot : document.at("plots")) field.plots.push_back(plot_from_json(plot));
  return field;
}

void write_plot_table(const std::filesystem::path& path, const FieldScore& field) {
  const std::set<std::string> heights = estimated_heights(field);
  const std::set<std::string> truths = true_heights(field);
  std::ofstream out(path);
  out << "plot_number,row_number,col_number,found,estimate,iou,center_error_m,heading_error_deg";
  for (const std::string& truth : truths) out << ",true_" << truth;
  for (const std::string& height : heights) out << ",estimated_height_" << height << "_m";
  out << '\n';
  for (const PlotScore& plot : field.plots) {
    out << plot.truth.id << ',' << plot.truth.row << ',' << plot.truth.column << ',';
    if (plot.found) {
      out << "1," << plot.found->estimate << ',' << format_number(plot.found->iou) << ','
          << format_number(plot.found->center_error_m) << ','
          << format_number(plot.found->heading_error_rad / kDegrees);
    } else {
      out << "0,,,,";
    }
    for (const std::string& truth : truths) out << ',' << height_at(plot.truth.heights_m, truth);
    for (const std::string& height : heights)
      out << ',' << (plot.found ? height_at(plot.found->heights_m, height) : "");
    out << '\n';
  }
  if (!out.flush()) throw InputError(path, "cannot be written");
}

}  // namespace plotscan::score
