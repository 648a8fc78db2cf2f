// SPDX-License-Identifier: Apache-2.0
#include "series/run.h"

#include <set>

#include "core/error.h"
#include "core/format_version.h"
#include "core/list_of.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/statistics.h"
#include "core/text.h"
#include "series/internal/dates.h"
#include "series/internal/series_files.h"

namespace plotscan::series {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

const char* name_of(JoinBy by) { return by == JoinBy::ids ? "ids" : "places"; }

// The manifest of a result; an empty object for a file, and a folder without one.
json manifest_of(const fs::path& estimate) {
  return fs::exists(estimate / "manifest.json") ? read_manifest(estimate) : json::object();
}

// The name by which the user knows a result: its folder's, or its file's without the extension.
std::string own_name(const fs::path& estimate) {
  const fs::path whole = fs::absolute(estimate).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).stem().string();
}

std::string date_of(const fs::path& estimate, const json& manifest) {
  const json::json_pointer flown("/results/flown");
  if (manifest.contains(flown) && manifest[flown].is_string())
    return manifest[flown].get<std::string>();
  return date_in(own_name(estimate));
}

DatedEstimate read_result(const fs::path& path, const std::string& date) {
  const json manifest = manifest_of(path);
  DatedEstimate result{.folder = path,
                       .date = date.empty() ? date_of(path, manifest) : date,
                       .estimate = estimate::read_estimate(path)};
  const json::json_pointer given("/results/diagnostics");
  result.ids_are_given = manifest.contains(given / "boxes") || manifest.contains(given / "names");
  for (const char* source : {"boxes", "names"}) {
    const json::json_pointer id = given / source / "id";
    if (manifest.contains(id)) result.estimate.id_property = manifest[id].get<std::string>();
  }
  const std::vector<PlotFeature> features = read_plot_features(estimated_map_of(path));
  for (std::size_t i = 0; i < features.size(); ++i) {
    result.estimate.plots[i].attributes = estimate::own_attributes(features[i]);
    result.estimate.plots[i].attributes.erase(result.estimate.id_property);
  }
  return result;
}

void require_sound(const RunOptions& options) {
  if (options.estimates.size() < 2) throw InputError("a series needs two estimates and more");
  if (!options.dates.empty() && options.dates.size() != options.estimates.size())
    throw InputError(fmt::format("--dates has {} dates, and there are {} estimates",
                                 options.dates.size(), options.estimates.size()));
}

void require_height(const Series& series, const std::string& height) {
  std::set<std::string> names;
  for (const PlotSeries& plot : series.plots) {
    for (const auto& at : plot.at) {
      if (!at) continue;
      for (const auto& [name, height_m] : at->heights_m) names.insert(name);
    }
  }
  if (names.contains(height)) return;
  throw InputError(fmt::format("no plot has a height {}; --height names one of {}",
                               in_quotes(height), joined({names.begin(), names.end()}, ", ")));
}

}  // namespace

std::vector<DateSummary> summary_of(const Series& series, const std::string& height) {
  std::vector<DateSummary> dates;
  for (std::size_t date = 0; date < series.dates.size(); ++date) {
    std::vector<double> heights_m, growth_m;
    for (const PlotSeries& plot : series.plots) {
      if (plot.at[date] && plot.at[date]->heights_m.contains(height))
        heights_m.push_back(plot.at[date]->heights_m.at(height));
      for (const Growth& growth : growth_of(plot, height))
        if (growth.to == date) growth_m.push_back(growth.growth_m);
    }
    dates.push_back({.date = series.dates[date],
                     .plots = heights_m.size(),
                     .median_m = quantile(heights_m, 0.5),
                     .grown = growth_m.size(),
                     .growth_m = quantile(growth_m, 0.5)});
  }
  return dates;
}

json to_json(const Series& series, const std::string& height) {
  const auto date_json = [](const DateSummary& date) {
    return json{{"date", date.date},
                {"plots", date.plots},
                {"median_m", date.median_m},
                {"grown", date.grown},
                {"median_growth_m", date.growth_m}};
  };
  return {{"plots", series.plots.size()},
          {"joined_by", name_of(series.joined_by)},
          {"height", height},
          {"dates", list_of(summary_of(series, height), date_json)},
          {"notes", series.notes}};
}

Series run(const RunOptions& options) {
  require_sound(options);
  OutputFolder folder(options.output, options.replace, "estimator series", options.estimates);
  std::vector<DatedEstimate> results;
  for (const fs::path& estimate : options.estimates) {
    const std::string date = options.dates.empty() ? "" : options.dates[results.size()];
    results.push_back(read_result(estimate, date));
  }
  Series series = joined_series(std::move(results), options.join);
  require_height(series, options.height);
  write_series(folder.path(), series, options.height);
  write_manifest(
      folder.path(),
      {.command = "estimator series",
       .options = {{"height", options.height},
                   {"dates", options.dates},
                   {"join", options.join ? json(name_of(*options.join)) : json(nullptr)}},
       .inputs = list_of(options.estimates, estimated_map_of),
       .results = to_json(series, options.height)});
  folder.commit();
  return series;
}

}  // namespace plotscan::series
