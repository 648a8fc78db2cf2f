// SPDX-License-Identifier: Apache-2.0
#include "methods/run.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "cloud/field_density.h"
#include "core/contains.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/statistics.h"
#include "core/text.h"
#include "core/utc_time.h"
#include "estimate/measured_heights.h"
#include "estimate/plot_map.h"
#include "estimate/plot_tables.h"
#include "methods/agree.h"
#include "record/positions.h"

namespace plotscan::methods {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::size_t kDay = std::string_view("2026-06-01").size();  // of an instant's text

template <class Value>
json to_json(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json options_json(const estimate::NumberingOptions& options) {
  const auto name_of = [](const std::vector<std::string>& names, auto place) {
    return names.at(static_cast<std::size_t>(place));
  };
  const auto corner = options.first_corner.value_or(estimate::Corner::sw);
  json document = {{"first_corner", name_of(estimate::corner_names(), corner)}};
  document["plot_names"] = options.names.has_value();
  if (options.names) return document;
  document["first_number"] = options.first_number.value_or(1);
  document["numbering"] =
      name_of(estimate::numbering_names(), options.numbering.value_or(PlotNumbering::rows));
  return document;
}

json options_json(const RecordingOptions& options) {
  json document = {{"sensor", to_json(options.sensor)}};
  if (options.trajectory) document["trajectory"] = options.trajectory->filename().string();
  if (const auto& mount = options.mount_rpy_deg)
    document["mount_rpy_deg"] = {mount->x(), mount->y(), mount->z()};
  if (!options.topic.empty()) document["topic"] = options.topic;
  return document;
}

json options_json(const RunOptions& options) {
  json document;
  for_each_method(options, [&](const std::string& name, const auto& settings, const auto& own) {
    if (name == options.method) document = settings_json(settings, own);
  });
  document["method"] = options.method;
  document["crop_box"] = to_json(options.crop_box);
  const CloudFiles& cloud = options.cloud;
  document["unit_m"] = cloud.units ? json(cloud.units->horizontal_m) : json(nullptr);
  document["crs"] = to_json(cloud.crs);
  if (cloud.recording.any()) document["recording"] = options_json(cloud.recording);
  document["leave_out_classes"] = cloud.leave_out_classes;
  document["given_boxes"] = options.boxes.has_value();
  document["id"] = to_json(options.id);
  if (options.measured) document["measured"] = true;
  if (options.numbering.any()) document["numbering"] = options_json(options.numbering);
  return document;
}

// Sets the options that all methods share; the seed only for a method that draws random numbers.
template <class Options>
Options completed(Options options, const RunOptions& run, const std::vector<PlotFeature>& boxes) {
  options.crop_box = run.crop_box;
  options.threads = run.threads;
  options.boxes.clear();
  for (const PlotFeature& feature : boxes) options.boxes.push_back(feature.box);
  if constexpr (requires { options.trials; }) {
    options.trials.clear();
    for (const PlotFeature& feature : boxes) options.trials.push_back(estimate::trial_of(feature));
  }
  if constexpr (requires { options.seed; }) options.seed = run.seed;
  return options;
}

estimate::Estimate run_method(const CloudFiles& cloud, const RunOptions& run,
                              const std::vector<PlotFeature>& boxes,
                              const ProgressReport& progress) {
  std::optional<estimate::Estimate> estimate;
  for_each_method(run, [&](const std::string& name, const auto&, const auto& own) {
    if (name == run.method) estimate = estimate_plots(cloud, completed(own, run, boxes), progress);
  });
  check(estimate.has_value(), "require_sound has refused an unknown method");
  return std::move(*estimate);
}

void require_sound(const RunOptions& options) {
  require_known(options.method);
  const estimate::NumberingOptions& numbering = options.numbering;
  if (options.boxes && numbering.any())
    throw InputError("plots in given boxes keep their ids: they are neither numbered nor named");
  if (numbering.names && (numbering.first_number || numbering.numbering))
    throw InputError("plots are numbered or named by a table, not both");
  if (options.id && !options.boxes && !numbering.names && !options.measured)
    throw InputError(
        "an id is a property of given boxes, or a column of plot names or measured heights; give "
        "one of these");
}

// The options with files in place of the folders that hold them.
RunOptions with_files(RunOptions options) {
  options.cloud.files = cloud_files_of(options.cloud.files);
  if (options.boxes) options.boxes = estimated_map_of(*options.boxes);
  return options;
}

// The clouds and the tables that the user gives.
std::vector<fs::path> inputs_of(const RunOptions& options) {
  std::vector<fs::path> files = options.cloud.files;
  if (options.cloud.recording.trajectory) files.push_back(*options.cloud.recording.trajectory);
  if (options.boxes) files.push_back(*options.boxes);
  if (options.numbering.names) files.push_back(*options.numbering.names);
  if (options.measured) files.push_back(*options.measured);
  return files;
}

// A table replaces no input, and does not lie in the folder that is replaced as a whole.
void require_own_place(const fs::path& table, const fs::path& folder,
                       const std::vector<fs::path>& inputs) {
  std::error_code ignored;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(table, input, ignored)) throw InputError(table, "is an input of the run");
  }
  const fs::path within =
      fs::weakly_canonical(table).lexically_relative(fs::weakly_canonical(folder));
  if (!within.empty() && *within.begin() != "..")
    throw InputError(table, "lies in the estimate folder, which has a heights.csv of its own");
}

// Names or numbers the plots as the user asked.
void name(const RunOptions& options, const estimate::PlotMap& map,
          const estimate::NamedPlaces& places, estimate::Estimate& estimate) {
  if (options.boxes) {
    estimate::take_names(map, estimate);
  } else if (options.numbering.names) {
    estimate::name_plots(options.numbering, places, estimate);
  } else if (options.numbering.any()) {
    estimate::number_plots(options.numbering, estimate);
  }
}

std::optional<cloud::Area> in_metres(std::optional<cloud::Area> area, double unit_m) {
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
void take_system(const scan::CloudSystem& system, const RunOptions& options,
                 estimate::Estimate& estimate) {
  estimate.crs = system.crs;
  if (!system.zone && (options.cloud.units || system.units != CoordinateUnits{}))
    estimate.units = system.units;
  std::vector<std::string> notes = system.notes;
  if (const auto& own = estimate.diagnostics.notes)
    notes.insert(notes.end(), own->begin(), own->end());
  estimate.diagnostics.notes = std::move(notes);
}

// What the user may state of the plots and has not, the most helpful first.
std::vector<std::string> hints_left(const RunOptions& options) {
  const lattice::Options& stated = options.lattice;
  std::vector<std::string> hints;
  if (!stated.plot_width_m && !stated.plot_length_m) {
    hints.emplace_back("give the plots' sides with --plot-width and --plot-length");
  } else if (!stated.plot_width_m || !stated.plot_length_m) {
    hints.emplace_back(stated.plot_width_m ? "give --plot-length as well"
                                           : "give --plot-width as well");
  } else if (!stated.heading_deg) {
    hints.emplace_back("give --heading as well");
  } else if (!stated.rows || !stated.columns) {
    hints.emplace_back("give --rows and --columns as well");
  }
  hints.emplace_back("say where plots are with --boxes");
  if (!options.crop_box) hints.emplace_back("cut the cloud to them with --crop-box");
  return hints;
}

// Advice for an estimate without plots, by what was found and what was stated.
std::string next_step(const RunOptions& options, const estimate::Estimate& estimate) {
  const double density_m2 = estimate.diagnostics.density_per_m2.value_or(cloud::kPlotsFound_m2);
  std::vector<std::string> steps;
  if (density_m2 >= cloud::kLeastSearched_m2) steps = hints_left(options);
  if (density_m2 < cloud::kPlotsFound_m2) steps.emplace_back("fly lower or slower for more points");
  if (!estimate.units && estimate.crs.empty())
    steps.emplace_back("give --units where coordinates are not metres");
  const std::string last = steps.back();
  steps.pop_back();
  return steps.empty() ? last : joined(steps, ", ") + ", or " + last;
}

}  // namespace

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    const RunOptions any;
    for_each_method(any,
                    [&](const char* name, const auto&, const auto&) { all.emplace_back(name); });
    return all;
  }();
  return names;
}

void require_known(const std::string& method) {
  if (contains(method_names(), method)) return;
  throw InputError("there is no method \"" + method + "\"; there is " +
                   joined(method_names(), ", "));
}

estimate::Estimate run(const RunOptions& options, const ProgressReport& progress) {
  require_sound(options);
  const RunOptions of_files = with_files(options);
  const CloudFiles& cloud = of_files.cloud;
  Manifest manifest{.command = "estimator run",
                    .seed = options.seed,
                    .options = options_json(options),
                    .inputs = inputs_of(of_files)};
  OutputFolder folder(options.output, options.replace, "estimator run", inputs_of(options));
  std::optional<OutputFile> table;
  if (options.csv) {
    require_own_place(*options.csv, options.output, manifest.inputs);
    table.emplace(*options.csv, options.replace);
  }
  const scan::CloudSystem system = record::read_cloud_system(cloud);
  const double unit_m = system.units.horizontal_m;
  estimate::PlotMap map;
  if (options.boxes) map = estimate::read_plot_map(*options.boxes, system.crs, unit_m, options.id);
  estimate::NamedPlaces places;
  if (options.numbering.names)
    places = estimate::read_named_places(*options.numbering.names, options.id);
  std::optional<estimate::MeasuredHeights> measured;
  if (options.measured) measured = estimate::read_measured_heights(*options.measured, options.id);
  estimate::Estimate estimate = run_method(cloud, in_metres(options, unit_m), map.plots, progress);
  take_system(system, options, estimate);
  name(options, map, places, estimate);
  if (measured) agree_with(*measured, estimate);
  estimate::write_estimate(folder.path(), estimate);
  manifest.results = {{"plots", estimate.plots.size()},
                      {"heights", height_summary(estimate)},
                      {"diagnostics", to_json(estimate.diagnostics)}};
  if (system.start) manifest.results["flown"] = format_utc(*system.start).substr(0, kDay);
  write_manifest(folder.path(), manifest);
  if (table) estimate::write_traits(table->path(), estimate);
  folder.commit();
  if (table) table->commit();
  return estimate;
}

void require_measured(const RunOptions& options, const estimate::Estimate& estimate) {
  const bool measured = std::ranges::any_of(
      estimate.plots, [](const estimate::PlotEstimate& plot) { return !plot.heights_m.empty(); });
  if (measured) return;
  const auto density_m2 = estimate.diagnostics.density_per_m2;
  const std::string found =
      density_m2 ? " (" + cloud::density_text(*density_m2) + " points/m2)" : "";
  if (!estimate.plots.empty()) {
    throw NothingToMeasure("no plot has enough points for a height" + found +
                           "; check that the boxes and the cloud are of one field, and fly lower "
                           "where points are few");
  }
  throw NothingToMeasure("no plots: " + estimate.diagnostics.why_no_plots + found + "; " +
                         next_step(options, estimate));
}

json height_summary(const estimate::Estimate& estimate) {
  std::map<std::string, std::vector<double>> heights_m;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
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

}  // namespace plotscan::methods
