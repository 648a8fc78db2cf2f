// SPDX-License-Identifier: Apache-2.0
#include "scanpage/scan_page.h"

#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "ground/surface.h"
#include "record/scan_folder.h"
#include "report/shown_field.h"
#include "report/shown_grid.h"
#include "scanpage/read_cloud.h"

namespace plotscan::scanpage {
namespace fs = std::filesystem;
namespace {

constexpr double kRead = 0.5;    // progress when the points are read
constexpr double kFitted = 0.8;  // progress when the ground is fitted

report::ShownPlot shown(const PlotFeature& plot, std::size_t place) {
  const nlohmann::json& properties = plot.properties;
  report::ShownPlot result{.id = std::to_string(place), .box = plot.box};
  for (const std::string& property : plot_id_properties()) {
    if (const auto id = id_in(plot, property)) {
      result.id = id->text();
      break;
    }
  }
  const auto whole = [&](const char* name) {
    const auto number = properties.find(name);
    return number != properties.end() && number->is_number_integer() ? number->get<int>() : 0;
  };
  result.row = whole("row_number");
  result.column = whole("col_number");
  result.trial = whole("trial_number");
  if (properties.contains("points")) return result;  // an estimate's heights are no truths
  for (const auto& [name, value] : properties.items()) {
    const bool is_height = name.starts_with("height_") || name.starts_with("canopy_");
    if (is_height && name.ends_with("_m") && value.is_number()) result.truths_m[name] = value;
  }
  return result;
}

std::vector<report::ShownPlot> read_plots(const std::optional<fs::path>& place) {
  std::vector<report::ShownPlot> plots;
  if (!place) return plots;
  for (const PlotFeature& plot : read_plot_features(plot_map_of(*place)))
    plots.push_back(shown(plot, plots.size() + 1));
  return plots;
}

std::vector<report::Fact> facts_of(const fs::path& scan, const report::ShownCloud& cloud) {
  std::vector<report::Fact> facts = {{"points of the scan", std::to_string(cloud.read)},
                                     {"points on this page", std::to_string(cloud.points.size())}};
  if (!fs::is_directory(scan)) return facts;
  const record::FlightRecord flight = record::read_flight_record(scan);
  facts.push_back({"sensor", flight.sensor.name});
  facts.push_back(
      {"flight", fmt::format("{:.1f} s", flight.reported.end_s() - flight.reported.start_s())});
  return facts;
}

// The ground fitted under a cloud's shown points; absent if they show none.
std::optional<report::ShownGrid> fitted_ground(const report::ShownCloud& cloud, int threads) {
  const std::vector<Eigen::Vector3f> places = list_of(cloud.points, &report::ShownPoint::place);
  try {
    return report::shown_grid(ground::fit_surface(places, {.threads = threads}), cloud.origin);
  } catch (const InputError&) {
    return std::nullopt;  // such as a too large field: the page then shows the cloud's own heights
  }
}

}  // namespace

report::PageSummary write_scan_page(const PageOptions& options, const ProgressReport& progress) {
  std::vector<fs::path> inputs = {options.scan};
  if (options.plots) inputs.push_back(*options.plots);
  report::require_page(options.html, inputs);
  OutputFile file(options.html, options.replace);
  const auto report_share = [&](double share) {
    if (progress) progress(share);
  };
  report::ShownField field{.name = report::shown_name(options.scan)};
  field.plots = read_plots(options.plots);
  ShownScan scan = read_shown_scan(options.scan, {.most = options.points, .source = options.source},
                                   [&](double share) { report_share(kRead * share); });
  field.facts = facts_of(options.scan, scan.cloud);
  field.ground = fitted_ground(scan.cloud, options.threads);
  report_share(kFitted);
  if (!field.ground)
    field.notes.emplace_back("No ground could be fitted: heights count from the lowest point.");
  field.path = std::move(scan.path);
  field.cloud = std::move(scan.cloud);
  report::note_cloud_elsewhere(field, field.name);
  auto summary = report::write_field_page(file.path(), "scan", "Scan " + field.name, field);
  file.commit();
  report_share(1);
  return summary;
}

}  // namespace plotscan::scanpage
