// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/run_farm.h"

#include <algorithm>
#include <iterator>

#include "cloud/cloud_map.h"
#include "core/contains.h"
#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/manifest.h"
#include "core/stopwatch.h"
#include "description/load_description.h"
#include "farmbench/internal/farm_view.h"
#include "farmbench/methods.h"
#include "lidar/fly_settings.h"
#include "planting/generate.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// How far a farm is when it has been flown, and when its cloud has been read.
constexpr double kFlown = 0.5;
constexpr double kRead = 0.6;
constexpr double kShown_m = 4;  // around the plots, on pages

// What the paper's operator drew by hand: the rectangle that holds the plots, with a margin.
cloud::Area field_area(const std::vector<score::TruePlot>& plots, double margin_m) {
  return cloud::around(extent_of(plots, &score::TruePlot::box), margin_m);
}

MethodRun run_method(const Method& method, const Field& field) {
  MethodRun run{.estimate = {.method = method.name}, .result = {.method = method.name}};
  const Stopwatch watch;
  const double spared_s = field.found.spared_s();
  try {
    run.estimate = method.estimate(field);
    run.estimate.method = method.name;
    run.result.diagnostics = to_json(run.estimate.diagnostics);
  } catch (const InputError& error) {
    run.result.failure = error.what();
  }
  run.result.seconds = watch.seconds() + field.found.spared_s() - spared_s;
  return run;
}

// `truth`: all plots of the field, those that are not scored among them.
MethodRun run_named(const std::string& name, const Suite& suite, const Field& field,
                    const std::vector<score::TruePlot>& truth) {
  const auto command = std::ranges::find(suite.commands, name, &CommandMethod::name);
  MethodRun run = command == suite.commands.end() ? run_method(method_named(name), field)
                                                  : run_command_method(*command, field);
  run.result.score = score::score_field(truth, run.estimate);
  return run;
}

void report_share(const ProgressReport& progress, double share) {
  if (progress) progress(share);
}

FarmResult farm_result(const FarmRun& run, const lidar::FlySummary& flown) {
  return {.case_name = run.place.suite_case.name,
          .seed = run.place.seed,
          .shots = flown.shots,
          .points = flown.points,
          .flight_s = flown.duration_s};
}

struct FieldScan {
  ScannedFarm scanned;
  cloud::CloudMap map;
};

FieldScan scan_field(const FarmPlace& place, const farm::Farm& farm, const cloud::Area& area,
                     const ProgressReport& progress) {
  ScannedFarm scanned =
      scan_farm(place, farm, [&](double share) { report_share(progress, kFlown * share); });
  cloud::CloudMap map = cloud::read_map(scanned.cloud, cloud::NamedArea{area, "farm's plots"});
  return {std::move(scanned), std::move(map)};
}

// The result of a sweep's flight that cannot be flown or saw nothing: no method finds a plot. The
// message omits the work folder, which differs from run to run.
FarmResult not_flown(const FarmRun& run, const std::vector<score::TruePlot>& plots,
                     std::string why) {
  const std::string work = run.place.folder.string() + "/";
  for (std::size_t at = 0; (at = why.find(work, at)) != std::string::npos;)
    why.erase(at, work.size());
  FarmResult result = farm_result(run, {});
  for (const std::string& name : run.suite.methods)
    result.methods.push_back({.method = name,
                              .failure = "no flight: " + why,
                              .score = score::score_field(plots, {.method = name})});
  return result;
}

// Adds each method's result, and gives their estimates.
std::vector<estimate::Estimate> run_methods(const Suite& suite, const Field& field,
                                            const std::vector<score::TruePlot>& truth,
                                            const ProgressReport& progress, FarmResult& result) {
  std::vector<estimate::Estimate> estimates;
  for (const std::string& name : suite.methods) {
    MethodRun method = run_named(name, suite, field, truth);
    result.methods.push_back(std::move(method.result));
    estimates.push_back(std::move(method.estimate));
    const double share =
        static_cast<double>(estimates.size()) / static_cast<double>(suite.methods.size());
    report_share(progress, kRead + (1 - kRead) * share);
  }
  return estimates;
}

FarmResult run_on_scan(const FarmRun& run, const farm::Farm& farm, const FieldScan& scan,
                       const std::vector<score::TruePlot>& truth, const cloud::Area& shown,
                       const ProgressReport& progress) {
  const auto& [suite_case, seed, folder, threads] = run.place;
  const std::vector<score::TruePlot> plots = those_of(truth, &score::TruePlot::scored);
  const fs::path poses = folder / "scan" / "poses.csv";
  FoundFields found(scan.scanned.cloud);
  const Field field{.cloud = scan.scanned.cloud,
                    .poses = poses,
                    .map = scan.map,
                    .plots = plots,
                    .terrain = farm.terrain,
                    .found = found,
                    .seed = seed,
                    .threads = threads};
  FarmResult result = farm_result(run, scan.scanned.flown);
  const std::vector<estimate::Estimate> estimates =
      run_methods(run.suite, field, truth, progress, result);
  if (run.view) {
    write_farm_view(*run.view, {.scan = suite_case.survey ? scan.scanned.cloud : folder / "scan",
                                .area = shown,
                                .points = view_points(run.suite),
                                .estimates = estimates,
                                .truth = truth,
                                .terrain = farm.terrain,
                                .result = result});
  }
  return result;
}

}  // namespace

json made_from(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
               const std::string& build) {
  json files = json::array();
  for (const fs::path& file : planting::input_files(
           description::load_description(suite_case.farm, suite_case.overrides))) {
    files.push_back({{"file", file.filename().string()}, {"hash", file_hash(file)}});
  }
  json document = {{"plotscan", version()},
                   {"build", build},
                   {"files", files},
                   {"set", suite_case.overrides},
                   {"seed", seed},
                   {"flight", lidar::settings_json(suite_case.flight)},
                   {"crop_margin_m", suite.crop_margin_m},
                   {"methods", suite.methods}};
  for (const CommandMethod& command : suite.commands) {
    if (contains(suite.methods, command.name)) document["commands"].push_back(made_from(command));
  }
  if (suite_case.survey) document["survey_m"] = *suite_case.survey;
  if (suite_case.without_plots) document["without_plots"] = true;
  return document;
}

FarmResult run_farm(const FarmRun& run, const ProgressReport& progress) {
  const FarmPlace& place = run.place;
  const farm::Farm farm = make_farm(place);
  std::vector<score::TruePlot> truth = standing_plots(place);
  const std::vector<score::TruePlot> plots = those_of(truth, &score::TruePlot::scored);
  const cloud::Area shown = field_area(truth, kShown_m);
  std::optional<FieldScan> scan;
  try {
    scan = scan_field(place, farm, field_area(plots, run.suite.crop_margin_m), progress);
  } catch (const InputError& error) {
    if (!run.suite.sweep) throw;
    return not_flown(run, plots, error.what());
  }
  report_share(progress, kRead);
  if (place.suite_case.without_plots) truth.clear();
  return run_on_scan(run, farm, *scan, truth, shown, progress);
}

}  // namespace plotscan::farmbench
