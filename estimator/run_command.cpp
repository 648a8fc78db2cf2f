// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "cloud_options.h"
#include "commands.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "method_options.h"
#include "methods/run.h"
#include "say_estimate.h"

namespace plotscan {
namespace {

struct RunArguments {
  CloudArguments cloud;
  methods::RunOptions options;
  std::vector<double> crop_box;
  std::string numbering;
  std::string first_corner;
  GivenSettings settings;  // of the method
};

std::optional<cloud::Area> area_of(const std::vector<double>& corners) {
  if (corners.empty()) return std::nullopt;
  return cloud::Area{corners[0], corners[1], corners[2], corners[3]};
}

estimate::NumberingOptions numbering_of(const RunArguments& arguments) {
  estimate::NumberingOptions numbering = arguments.options.numbering;
  if (!arguments.numbering.empty())
    numbering.numbering = estimate::numbering_named(arguments.numbering);
  if (!arguments.first_corner.empty())
    numbering.first_corner = estimate::corner_named(arguments.first_corner);
  return numbering;
}

// Small runs stay quiet.
void say_ahead(const Program& program, const methods::lattice::WorkEstimate& work) {
  constexpr double kQuick_s = 2;
  if (work.seconds < kQuick_s) return;
  program.announce(fmt::format("ahead      about {:.2g} s and {:.2g} GB of memory", work.seconds,
                               work.gigabytes));
}

// The run options that the arguments ask for.
methods::RunOptions chosen_options(const Program& program, const RunArguments& arguments) {
  methods::RunOptions options = arguments.options;
  options.crop_box = area_of(arguments.crop_box);
  options.cloud = cloud_of(arguments.cloud);
  options.seed = program.common().seed;
  options.threads = program.common().threads;
  take_settings(arguments.settings, options);
  options.numbering = numbering_of(arguments);
  if (options.method == "dhami2020" && !options.boxes && !arguments.settings.contains("--plots")) {
    throw InputError("--plots is missing: how many plots lie in the field (or in --learn-box)");
  }
  options.lattice.on_work = [&program](const methods::lattice::WorkEstimate& work) {
    say_ahead(program, work);
  };
  return options;
}

void run_estimate(const Program& program, const RunArguments& arguments) {
  const methods::RunOptions options = chosen_options(program, arguments);
  const Stopwatch watch;
  const estimate::Estimate estimate = methods::run(options, program.progress("estimating"));
  const double seconds = watch.seconds();
  const nlohmann::json summary = methods::height_summary(estimate);
  say_estimate(program, estimate, summary);
  program.say("{} plots in {:.1f} s, written to {}", estimate.plots.size(), seconds,
              options.output.string());
  if (options.csv) program.say("           and " + options.csv->string());
  program.result({{"output", options.output.string()},
                  {"plots", estimate.plots.size()},
                  {"heights", summary},
                  {"diagnostics", to_json(estimate.diagnostics)},
                  {"seconds", seconds}});
  methods::require_measured(options, estimate);
}

// Which of the cloud's points and plots are measured.
void declare_parts(CLI::App& run, RunArguments& arguments) {
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
      "--boxes", arguments.options.boxes,
      "map of the plots (GeoJSON, GeoPackage, shapefile, an earlier estimate's folder), in the "
      "cloud's units, or in longitude and latitude where the cloud is in UTM or degrees: heights "
      "are measured in its boxes, its ids and attributes kept, and no plots searched for");
}

// What the plots are called.
void declare_names(CLI::App& run, RunArguments& arguments) {
  run.add_option(
      "--id", arguments.options.id,
      "property of --boxes, or column of --plot-names and --measured, that is the plots' "
      "id (default: the first there is of plot_number, plot_id, plot_name, observationUnitName, "
      "observationunit_name, name, id)");
  run.add_option("--first-number", arguments.options.numbering.first_number,
                 "number of the first plot that is found; the others follow along the rows "
                 "(default: 1)")
      ->check(CLI::Range(std::uint32_t{0}, std::uint32_t{1000000000}))
      ->excludes("--boxes");
  run.add_option("--numbering", arguments.numbering,
                 "zigzag: every row from its first column (default); serpentine: every other row "
                 "from its last")
      ->check(CLI::IsMember(estimate::numbering_names()))
      ->excludes("--boxes");
  run.add_option("--first-corner", arguments.first_corner,
                 "corner of the field with row 1 and column 1, where plots are numbered or named "
                 "(default: sw)")
      ->check(CLI::IsMember(estimate::corner_names()))
      ->excludes("--boxes");
  run.add_option("--plot-names", arguments.options.numbering.names,
                 "table (CSV) with columns row, column, an id and others: plots that are found get "
                 "the id and the other columns of their place")
      ->excludes("--boxes", "--first-number", "--numbering");
}

void declare_measured(CLI::App& run, RunArguments& arguments) {
  run.add_option("--measured", arguments.options.measured,
                 "table (CSV) of heights measured by hand in at least 5 plots: their ids, and "
                 "columns such as height_mean_cm; the field's heights of these names are scaled to "
                 "agree with them");
}

}  // namespace

void declare_run(Program& program) {
  const auto shared = std::make_shared<RunArguments>();
  RunArguments& arguments = *shared;
  CLI::App& run =
      program.command("run", "Find the plots of a cloud and measure their crop heights.",
                      [&program, shared] { run_estimate(program, *shared); },
                      {.seed = "seed of the clustering of dhami2020", .threads = true});
  auto& options = arguments.options;
  declare_cloud(run, arguments.cloud);
  run.add_option("-o,--output", options.output, "estimate folder to write")->required();
  run.add_option("--method", options.method,
                 "lattice: needs only the cloud; dhami2020: the paper's method, needs "
                 "--plots")
      ->check(CLI::IsMember(methods::method_names()));
  declare_parts(run, arguments);
  declare_names(run, arguments);
  declare_measured(run, arguments);
  run.add_option("--csv", options.csv,
                 "also write a table (CSV) for breeding databases, one line for each plot: "
                 "observationunit_name, attributes, heights (metres)");
  run.add_flag("--force", options.replace, "replace an existing estimate folder and table");
  declare_methods(run, arguments.settings);
}

}  // namespace plotscan
