// SPDX-License-Identifier: Apache-2.0
#include "estimate/run.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/statistics.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

fs::path cloud_file(const fs::path& cloud) {
  fs::path file = fs::is_directory(cloud) ? cloud / "cloud.pcd" : cloud;
  require_file(file);
  return file;
}

json to_json(const std::optional<Area>& area) { return area ? json(*area) : json(nullptr); }

json options_json(const RunOptions& run) {
  const Dhami2020Options& options = run.dhami2020;
  return {{"method", run.method},
          {"plots", options.plots},
          {"crop_box_m", to_json(options.crop_box)},
          {"learn_box_m", to_json(options.learn_box)},
          {"given_boxes", run.boxes.has_value()},
          {"level", options.level},
          {"voxel_m", options.voxel_m},
          {"min_height_m", options.min_height_m},
          {"orientation_bin_rad", options.orientation_bin_rad},
          {"width_bin_m", options.width_bin_m},
          {"length_bin_m", options.length_bin_m},
          {"extend_m", options.extend_m},
          {"plane_tolerance_m", options.plane_tolerance_m}};
}

// A plot measured in a given box keeps the number, row and column that the file gives it.
void take_names(const std::vector<PlotFeature>& features, std::vector<PlotEstimate>& plots) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    const PlotEstimate named = plot_of(features[i], i + 1);
    plots[i].id = named.id;
    plots[i].row = named.row;
    plots[i].column = named.column;
  }
}

}  // namespace

Estimate run(const RunOptions& options, const ProgressReport& progress) {
  if (options.method != "dhami2020") {
    throw InputError("there is no method \"" + options.method + "\"; there is dhami2020");
  }
  const fs::path cloud = cloud_file(options.cloud);
  OutputFolder folder(options.output, options.replace, "estimator run");
  Dhami2020Options method_options = options.dhami2020;
  Manifest manifest{.command = "estimator run",
                    .seed = method_options.seed,
                    .options = options_json(options),
                    .inputs = {cloud}};
  std::vector<PlotFeature> features;
  if (options.boxes) {
    features = read_plot_features(*options.boxes);
    if (features.empty()) throw InputError(*options.boxes, "has no plots");
    for (const PlotFeature& feature : features) method_options.boxes.push_back(feature.box);
    manifest.inputs.push_back(*options.boxes);
  }
  Estimate estimate = dhami2020(cloud, method_options, progress);
  take_names(features, estimate.plots);
  write_estimate(folder.path(), estimate);
  manifest.results = {{"plots", estimate.plots.size()},
                      {"heights", height_summary(estimate)},
                      {"diagnostics", estimate.diagnostics}};
  write_manifest(folder.path(), manifest);
  folder.commit();
  return estimate;
}

json height_summary(const Estimate& estimate) {
  std::map<std::string, std::vector<double>> heights_m;
  for (const PlotEstimate& plot : estimate.plots) {
    for (const auto& [name, height_m] : plot.heights_m) heights_m[name].push_back(height_m);
  }
  json summary = json::object();
  for (const auto& [name, values] : heights_m) {
    summary[name] = {{"plots", values.size()},
                     {"median_m", quantile(values, 0.5)},
                     {"min_m", std::ranges::min(values)},
                     {"max_m", std::ranges::max(values)}};
  }
  return summary;
}

}  // namespace plotscan::estimate
