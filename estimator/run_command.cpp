// SPDX-License-Identifier: Apache-2.0
#include "run_command.h"

#include <chrono>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "cloud_options.h"
#include "say_estimate.h"

#include "core/error.h"
#include "core/text.h"
#include "estimate/run.h"
#include "heights/measure_heights.h"

namespace plotscan {
namespace {

// Groups of options, each named as the method that it belongs to.
constexpr const char* kLatticeGroup = "lattice";
constexpr const char* kDhamiGroup = "dhami2020";

struct RunArguments {
  const CLI::App* command = nullptr;
  CloudArguments cloud;
  estimate::RunOptions options;
  std::vector<double> crop_box;
  std::vector<double> learn_box;
  std::string boxes;
  std::string id;
  std::string plot_names;
  std::string numbering;
  std::string first_corner;
  std::string csv;
  std::optional<double> heading_deg;
  std::optional<int> plots;
  bool no_calibration = false;
  bool no_level = false;
};

std::optional<estimate::Area> area_of(const std::vector<double>& corners) {
  if (corners.empty()) return std::nullopt;
  return estimate::Area{corners[0], corners[1], corners[2], corners[3]};
}

// An option of another method would have no effect, and says so.
void require_own_options(const CLI::App& command, const std::string& method) {
  for (const CLI::Option* option : command.get_options()) {
    const bool of_a_method =
        option->get_group() == kLatticeGroup || option->get_group() == kDhamiGroup;
    if (!of_a_method || option->get_group() == method || option->count() == 0) continue;
    throw InputError(option->get_name() + " belongs to --method " + option->get_group() +
                     ", and the method is " + method);
  }
}

estimate::NumberingOptions numbering_of(const RunArguments& arguments) {
  using estimate::Corner;
  static const std::map<std::string, Corner> corners = {
      {"sw", Corner::sw}, {"se", Corner::se}, {"nw", Corner::nw}, {"ne", Corner::ne}};
  estimate::NumberingOptions numbering = arguments.options.numbering;
  if (!arguments.numbering.empty()) {
    numbering.numbering =
        arguments.numbering == "serpentine" ? PlotNumbering::serpentine : PlotNumbering::rows;
  }
  if (!arguments.first_corner.empty()) numbering.first_corner = corners.at(arguments.first_corner);
  if (!arguments.plot_names.empty()) numbering.names = arguments.plot_names;
  return numbering;
}

// Small runs stay quiet.
void say_ahead(const Program& program, const estimate::WorkEstimate& work) {
  constexpr double kQuick_s = 2;
  if (work.seconds < kQuick_s) return;
  program.announce(
      formatted("ahead      about %.2g s and %.2g GB of memory", work.seconds, work.gigabytes));
}

void run_estimate(const Program& program, RunArguments arguments) {
  require_own_options(*arguments.command, arguments.options.method);
  estimate::RunOptions& options = arguments.options;
  options.crop_box = area_of(arguments.crop_box);
  options.cloud = cloud_of(arguments.cloud);
  options.seed = program.common().seed;
  options.threads = program.common().threads;
  options.dhami2020.learn_box = area_of(arguments.learn_box);
  options.dhami2020.level = !arguments.no_level;
  options.lattice.calibrated = !arguments.no_calibration;
  options.lattice.hints.plots = arguments.plots;
  options.dhami2020.plots = arguments.plots.value_or(0);
  if (arguments.heading_deg) {
    options.lattice.hints.heading_rad = *arguments.heading_deg * std::numbers::pi / 180;
  }
  if (!arguments.boxes.empty()) options.boxes = arguments.boxes;
  if (!arguments.id.empty()) options.id = arguments.id;
  options.numbering = numbering_of(arguments);
  if (!arguments.csv.empty()) options.csv = arguments.csv;
  if (options.method == "dhami2020" && arguments.boxes.empty() && !arguments.plots) {
    throw InputError("--plots is missing: how many plots lie in the field (or in --learn-box)");
  }
  options.lattice.tell = [&](const estimate::WorkEstimate& work) { say_ahead(program, work); };
  const auto start = std::chrono::steady_clock::now();
  const estimate::Estimate estimate = estimate::run(options, program.progress("estimating"));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const nlohmann::json summary = estimate::height_summary(estimate);
  say_estimate(program, estimate, summary);
  program.say(formatted("%zu plots in %.1f s, written to %s", estimate.plots.size(), seconds,
                        options.output.c_str()));
  if (options.csv) program.say("           and " + options.csv->string());
  program.result({{"output", options.output.string()},
                  {"plots", estimate.plots.size()},
                  {"heights", summary},
                  {"diagnostics", estimate.diagnostics},
                  {"seconds", seconds}});
  estimate::require_measured(estimate);
}

void declare_lattice(CLI::App& run, RunArguments& arguments) {
  const std::string group = kLatticeGroup;
  auto& method = arguments.options.lattice;
  run.add_option(
         "--heading", arguments.heading_deg,
         "direction of the plots' length, degrees counter-clockwise from x (default: found)")
      ->group(group);
  run.add_option("--plot-width", method.hints.width_m,
                 "width of every plot, metres (default: found)")
      ->group(group);
  run.add_option("--plot-length", method.hints.length_m,
                 "length of every plot, metres (default: found)")
      ->group(group);
  run.add_option("--rows", method.hints.rows,
                 "number of rows, which follow each other along the plots' length (default: found)")
      ->group(group);
  run.add_option("--columns", method.hints.columns,
                 "number of columns, along the plots' width (default: found)")
      ->group(group);
  run.add_option("--crop", method.crop, "crop of the field (default: recognised from the canopy)")
      ->check(CLI::IsMember(heights::crop_names()))
      ->group(group);
  run.add_option("--noise", method.noise_m,
                 "sigma of the points' heights (metres; default: estimated from bare ground)")
      ->group(group);
  run.add_option("--ground-class", method.ground_classes,
                 "only points of these ASPRS classes may be ground, separated by commas; 2 is "
                 "ground (default: every point may)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 255))
      ->group(group);
  run.add_flag("--no-calibration", arguments.no_calibration,
               "report the canopy's own mean and percentiles as the plants'")
      ->group(group);
}

void declare_dhami2020(CLI::App& run, RunArguments& arguments) {
  const std::string group = kDhamiGroup;
  auto& method = arguments.options.dhami2020;

  run.add_option("--learn-box", arguments.learn_box,
                 "x0,y0,x1,y1 in the cloud's units: learn box size and grid in this part of the "
                 "field, which has --plots plots, and extend the grid over the whole field")
      ->delimiter(',')
      ->expected(4)
      ->excludes("--boxes")
      ->group(group);
  run.add_option("--voxel", method.voxel_m, "edge of the voxel filter's cells, metres")
      ->group(group);
  run.add_option("--min-height", method.min_height_m,
                 "points this far above the levelled ground are crop, metres")
      ->group(group);
  run.add_flag("--no-level", arguments.no_level,
               "take z = 0 for the ground instead of levelling the map")
      ->group(group);
  run.add_option("--extend", method.extend_m,
                 "lengthen each end of a box by this to show the ground, metres")
      ->group(group);
  run.add_option("--plane-tolerance", method.plane_tolerance_m,
                 "distance to the ground plane within which RANSAC takes a point for ground, "
                 "metres")
      ->group(group);
}

// What the plots are called.
void declare_names(CLI::App& run, RunArguments& arguments) {
  run.add_option("--id", arguments.id,
                 "property of --boxes, or column of --plot-names, that is the plots' id (default: "
                 "the first there is of plot_number, plot_id, plot_name, observationUnitName, "
                 "name, id)");
  run.add_option("--first-number", arguments.options.numbering.first_number,
                 "number of the first plot that is found; the others follow along the rows "
                 "(default: 1)")
      ->check(CLI::Range(std::uint32_t{0}, std::uint32_t{1000000000}))
      ->excludes("--boxes");
  run.add_option("--numbering", arguments.numbering,
                 "zigzag: every row from its first column (default); serpentine: every other row "
                 "from its last")
      ->check(CLI::IsMember({"zigzag", "serpentine"}))
      ->excludes("--boxes");
  run.add_option("--first-corner", arguments.first_corner,
                 "corner of the field with row 1 and column 1, where plots are numbered or named "
                 "(default: sw)")
      ->check(CLI::IsMember({"sw", "se", "nw", "ne"}))
      ->excludes("--boxes");
  run.add_option("--plot-names", arguments.plot_names,
                 "table (CSV) with columns row, column, an id and others: plots that are found get "
                 "the id and the other columns of their place")
      ->excludes("--boxes", "--first-number", "--numbering");
}

}  // namespace

void declare_run(Program& program) {
  const auto shared = std::make_shared<RunArguments>();
  RunArguments& arguments = *shared;
  CLI::App& run =
      program.command("run", "Find the plots of a cloud and measure their crop heights.",
                      [&program, shared] { run_estimate(program, *shared); },
                      {.seed = "seed of the clustering of dhami2020", .threads = true});
  arguments.command = &run;
  auto& options = arguments.options;
  declare_cloud(run, arguments.cloud);
  run.add_option("-o,--output", options.output, "estimate folder to write")->required();
  run.add_option("--method", options.method,
                 "lattice: needs only the cloud; dhami2020: the paper's method, needs "
                 "--plots")
      ->check(CLI::IsMember(estimate::method_names()))
      ->capture_default_str();
  run.add_option("--crop-box", arguments.crop_box,
                 "x0,y0,x1,y1 in the cloud's units: use only the points in this box (default: the "
                 "densely scanned field)")
      ->delimiter(',')
      ->expected(4);
  run.add_option(
         "--leave-out-class", arguments.cloud.cloud.leave_out_classes,
         "ASPRS classes of points to leave out, separated by commas: 3,4,5 is vegetation, 6 "
         "buildings")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 255));
  run.add_option(
      "--boxes", arguments.boxes,
      "map of the plots (GeoJSON, GeoPackage, shapefile), in the cloud's units, or in "
      "longitude and latitude "
      "where the cloud is in UTM or degrees: heights are measured in its boxes, its ids and "
      "attributes kept, and no plots searched for");
  declare_names(run, arguments);
  run.add_option("--csv", arguments.csv,
                 "also write a table (CSV) for breeding databases, one line for each plot: "
                 "observationunit_name, attributes, heights (metres)");
  run.add_option("--plots", arguments.plots,
                 "how many plots lie in the field, or in --learn-box (1 to 100000; dhami2020 needs "
                 "it)")
      ->excludes("--boxes");
  run.add_flag("--force", options.replace, "replace an existing estimate folder and table");
  declare_lattice(run, arguments);
  declare_dhami2020(run, arguments);
}

}  // namespace plotscan
