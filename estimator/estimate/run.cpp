// SPDX-License-Identifier: Apache-2.0
#include "estimate/run.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/statistics.h"
#include "core/text.h"
#include "scan/cloud_reader.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr double kDegrees = std::numbers::pi / 180;

template <class Number>
json to_json(const std::optional<Number>& value) {
  return value ? json(*value) : json(nullptr);
}

json options_json(const LatticeOptions& options) {
  const std::optional<double>& heading = options.hints.heading_rad;
  return {{"heading_deg", heading ? json(*heading / kDegrees) : json(nullptr)},
          {"plot_width_m", to_json(options.hints.width_m)},
          {"plot_length_m", to_json(options.hints.length_m)},
          {"noise_m", to_json(options.noise_m)},
          {"calibrated", options.calibrated}};
}

json options_json(const Dhami2020Options& options) {
  return {{"plots", options.plots},
          {"learn_box_m", to_json(options.learn_box)},
          {"level", options.level},
          {"voxel_m", options.voxel_m},
          {"min_height_m", options.min_height_m},
          {"orientation_bin_rad", options.orientation_bin_rad},
          {"width_bin_m", options.width_bin_m},
          {"length_bin_m", options.length_bin_m},
          {"extend_m", options.extend_m},
          {"plane_tolerance_m", options.plane_tolerance_m}};
}

json options_json(const RunOptions& options) {
  json document =
      options.method == "lattice" ? options_json(options.lattice) : options_json(options.dhami2020);
  document["method"] = options.method;
  document["crop_box"] = to_json(options.crop_box);
  const CloudFiles& cloud = options.cloud;
  document["unit_m"] = cloud.units ? json(cloud.units->horizontal_m) : json(nullptr);
  document["leave_out_classes"] = cloud.leave_out_classes;
  document["given_boxes"] = options.boxes.has_value();
  return document;
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

// What every method is told, beside what is its own.
template <class Options>
Options completed(Options options, const RunOptions& run, const std::vector<PlotFeature>& boxes) {
  options.crop_box = run.crop_box;
  options.threads = run.threads;
  options.boxes.clear();
  for (const PlotFeature& feature : boxes) options.boxes.push_back(feature.box);
  return options;
}

Estimate run_method(const CloudFiles& cloud, const RunOptions& run,
                    const std::vector<PlotFeature>& boxes, const ProgressReport& progress) {
  if (run.method == "lattice") return lattice(cloud, completed(run.lattice, run, boxes), progress);
  Dhami2020Options options = completed(run.dhami2020, run, boxes);
  options.seed = run.seed;
  return dhami2020(cloud, options, progress);
}

std::vector<PlotFeature> read_boxes(const fs::path& file, double unit_m) {
  std::vector<PlotFeature> features = read_plot_features(file, unit_m);
  if (features.empty()) throw InputError(file, "has no plots");
  return features;
}

std::optional<Area> in_metres(std::optional<Area> area, double unit_m) {
  if (area) std::ranges::transform(*area, area->begin(), [&](double at) { return unit_m * at; });
  return area;
}

// The areas of the options in metres.
RunOptions in_metres(RunOptions options, double unit_m) {
  options.crop_box = in_metres(options.crop_box, unit_m);
  options.dhami2020.learn_box = in_metres(options.dhami2020.learn_box, unit_m);
  return options;
}

// What the cloud's file says of its coordinates; the units that results are written in.
void take_system(const scan::CloudSystem& system, const RunOptions& options, Estimate& estimate) {
  estimate.crs = system.crs;
  if (!system.zone && (options.cloud.units || system.units != CoordinateUnits{}))
    estimate.units = system.units;
  estimate.diagnostics["notes"] = system.notes;
}

}  // namespace

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"lattice", "dhami2020"};
  return names;
}

Estimate run(const RunOptions& options, const ProgressReport& progress) {
  if (std::ranges::find(method_names(), options.method) == method_names().end()) {
    throw InputError("there is no method \"" + options.method + "\"; there is " +
                     joined(method_names(), ", "));
  }
  CloudFiles cloud = options.cloud;
  cloud.files = cloud_files_of(options.cloud.files);
  std::vector<fs::path> inputs = options.cloud.files;
  if (options.boxes) inputs.push_back(*options.boxes);
  OutputFolder folder(options.output, options.replace, "estimator run", inputs);
  Manifest manifest{.command = "estimator run",
                    .seed = options.seed,
                    .options = options_json(options),
                    .inputs = cloud.files};
  const scan::CloudSystem system = scan::read_cloud_system(cloud);
  const double unit_m = system.units.horizontal_m;
  std::vector<PlotFeature> boxes;
  if (options.boxes) {
    boxes = read_boxes(*options.boxes, unit_m);
    manifest.inputs.push_back(*options.boxes);
  }
  Estimate estimate = run_method(cloud, in_metres(options, unit_m), boxes, progress);
  take_system(system, options, estimate);
  take_names(boxes, estimate.plots);
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
