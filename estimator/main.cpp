// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "info_command.h"

#include "core/error.h"
#include "core/geodesy.h"
#include "core/program.h"
#include "core/text.h"
#include "estimate/run.h"
#include "heights/measure_heights.h"
#include "score/run.h"

namespace plotscan {
namespace {

// Groups of options, each named as the method that it belongs to.
constexpr const char* kLatticeGroup = "lattice";
constexpr const char* kDhamiGroup = "dhami2020";

struct RunArguments {
  const CLI::App* command = nullptr;
  estimate::RunOptions options;
  std::vector<double> crop_box;
  std::vector<double> learn_box;
  std::string boxes;
  std::string units;
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

void say_votes(const Program& program, const nlohmann::json& diagnostics) {
  const auto& plot = diagnostics["plot"];
  const auto& votes = diagnostics["votes"];
  program.say(formatted("plot size  %.2f x %.2f m, heading %.1f deg", plot["width_m"].get<double>(),
                        plot["length_m"].get<double>(), plot["heading_deg"].get<double>()));
  program.say(formatted("votes      of %zu clusters: width %zu, length %zu, heading %zu",
                        votes["clusters"].get<std::size_t>(), votes["width"].get<std::size_t>(),
                        votes["length"].get<std::size_t>(), votes["heading"].get<std::size_t>()));
  const auto& grid = diagnostics["grid"];
  std::string pitch;
  if (grid.contains("column_step_m"))
    pitch += formatted(", %.2f m along the width", grid["column_step_m"].get<double>());
  if (grid.contains("row_step_m"))
    pitch += formatted(", %.2f m along the length", grid["row_step_m"].get<double>());
  program.say(formatted("grid       %zu clusters agree to %.2f m rms%s",
                        grid["agreeing_clusters"].get<std::size_t>(), grid["rms_m"].get<double>(),
                        pitch.c_str()));
}

void say_field(const Program& program, const nlohmann::json& diagnostics) {
  if (diagnostics.contains("nothing")) return;
  const auto& field = diagnostics["field"];
  const auto number = [&](const char* name) { return field.value(name, std::nan("")); };
  program.say(formatted("plot size  %.2f x %.2f m, heading %.2f deg", number("width_m"),
                        number("length_m"), number("heading_deg")));
  program.say(formatted("lattice    %.0f rows, %.0f columns", number("rows"), number("columns")));
}

void say_crop(const Program& program, const nlohmann::json& crops) {
  std::vector<std::string> likely;
  for (const auto& [crop, probability] : crops.items()) {
    constexpr double kLeast = 0.005;
    if (probability.get<double>() >= kLeast)
      likely.push_back(formatted("%s %.0f %%", crop.c_str(), 100 * probability.get<double>()));
  }
  program.say("crop       " + joined(likely, ", "));
}

// "EPSG:25832 (UTM 32N; ETRS89 is taken for WGS 84, within 2 m)", of a system that is UTM's.
std::string described(const std::string& crs) {
  const UtmSystem system = utm_system(crs).value();
  std::string text =
      crs + formatted(" (UTM %d%c", system.zone.number, system.zone.north ? 'N' : 'S');
  if (system.datum != "WGS 84") text += "; " + system.datum + " is taken for WGS 84, within 2 m";
  return text + ")";
}

void say_given(const Program& program, const estimate::Estimate& estimate) {
  if (!estimate.diagnostics.contains("boxes")) return;
  program.say(formatted("boxes      %zu plots given, %s %s to %s", estimate.plots.size(),
                        estimate.id_property.c_str(), estimate.plots.front().id.text().c_str(),
                        estimate.plots.back().id.text().c_str()));
  if (estimate.diagnostics["boxes"]["from_degrees"].get<bool>()) {
    program.say("           longitude and latitude of the map converted to " +
                described(estimate.crs));
  }
}

// Whose names were given by row and column, and found no plot.
void say_named(const Program& program, const estimate::Estimate& estimate) {
  if (!estimate.diagnostics.contains("names")) return;
  const auto& names = estimate.diagnostics["names"];
  const auto& not_found = names["not_found"];
  program.say(formatted("names      %zu of %zu named plots found, %s %s to %s",
                        estimate.plots.size(), names["plots"].get<std::size_t>(),
                        estimate.id_property.c_str(), estimate.plots.front().id.text().c_str(),
                        estimate.plots.back().id.text().c_str()));
  if (not_found.empty()) return;
  std::vector<std::string> ids;
  for (const auto& id : not_found) ids.push_back(id.get<std::string>());
  program.say("           not found: " + joined(ids, ", "));
}

void say_how(const Program& program, const nlohmann::json& diagnostics, double unit_m) {
  for (const auto& note : diagnostics.value("notes", nlohmann::json::array()))
    program.say("note       " + note.get<std::string>());
  program.say(formatted("points     %zu read, %zu in the field",
                        diagnostics["points_read"].get<std::size_t>(),
                        diagnostics["points_in_area"].get<std::size_t>()));
  const auto& area = diagnostics["area_m"];
  const auto side = [&](int i) { return area[i].get<double>() / unit_m; };
  program.say(formatted("field      x %.1f to %.1f, y %.1f to %.1f (%s)", side(0), side(2), side(1),
                        side(3), unit_name(unit_m).c_str()));
  if (diagnostics.contains("ground")) {
    const auto& ground = diagnostics["ground"];
    program.say(formatted("ground     seen in %.0f %% of %.1f m cells, noise %.1f cm",
                          100 * ground["seen_share"].get<double>(), ground["cell_m"].get<double>(),
                          100 * ground["noise_m"].get<double>()));
  }
  if (diagnostics.contains("votes")) say_votes(program, diagnostics);
  if (diagnostics.contains("field")) say_field(program, diagnostics);
  if (diagnostics.contains("crops")) say_crop(program, diagnostics["crops"]);
}

void say_flags(const Program& program, const estimate::Estimate& estimate) {
  constexpr std::size_t kNamed = 5;
  std::map<std::string, std::vector<std::string>> ids_by_flag;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    for (const std::string& flag : plot.flags) ids_by_flag[flag].push_back(plot.id.text());
  }
  for (const auto& [flag, ids] : ids_by_flag) {
    const std::string named = ids.size() <= kNamed ? " (" + joined(ids, ", ") + ")" : "";
    program.say(formatted("flagged    %zu of %zu plots: %s%s", ids.size(), estimate.plots.size(),
                          flag.c_str(), named.c_str()));
  }
}

void say_heights(const Program& program, const nlohmann::json& summary) {
  for (const auto& [name, height] : summary.items()) {
    program.say(formatted("%-10s median %.3f m, %.3f to %.3f m, %zu plots", name.c_str(),
                          height["median_m"].get<double>(), height["min_m"].get<double>(),
                          height["max_m"].get<double>(), height["plots"].get<std::size_t>()));
  }
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

void run_estimate(const Program& program, RunArguments arguments) {
  require_own_options(*arguments.command, arguments.options.method);
  estimate::RunOptions& options = arguments.options;
  options.crop_box = area_of(arguments.crop_box);
  if (const auto unit_m = unit_named(arguments.units)) options.cloud.units = {*unit_m, *unit_m};
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
  const auto start = std::chrono::steady_clock::now();
  const estimate::Estimate estimate = estimate::run(options, program.progress("estimating"));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const nlohmann::json summary = estimate::height_summary(estimate);
  say_how(program, estimate.diagnostics, estimate.units ? estimate.units->horizontal_m : 1);
  say_given(program, estimate);
  say_named(program, estimate);
  say_heights(program, summary);
  say_flags(program, estimate);
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
  run.add_option("--heading", arguments.heading_deg,
                 "direction of the plots' length, counter-clockwise from x (degrees)")
      ->group(group);
  run.add_option("--plot-width", method.hints.width_m, "of every plot (metres)")->group(group);
  run.add_option("--plot-length", method.hints.length_m, "of every plot (metres)")->group(group);
  run.add_option("--rows", method.hints.rows,
                 "rows of plots; they follow each other along the length")
      ->group(group);
  run.add_option("--columns", method.hints.columns, "columns of plots; along the width")
      ->group(group);
  run.add_option("--crop", method.crop, "soybean, wheat or maize (default: told from the canopy)")
      ->check(CLI::IsMember(heights::crop_names()))
      ->group(group);
  run.add_option("--noise", method.noise_m,
                 "sigma of the points' heights (metres; default: estimated from bare ground)")
      ->group(group);
  run.add_flag("--no-calibration", arguments.no_calibration,
               "give the canopy's own mean and percentiles for the plants'")
      ->group(group);
}

void declare_dhami2020(CLI::App& run, RunArguments& arguments) {
  const std::string group = kDhamiGroup;
  auto& method = arguments.options.dhami2020;

  run.add_option("--learn-box", arguments.learn_box,
                 "x0,y0,x1,y1: learn box size and grid in here, where --plots plots lie, and carry "
                 "the grid over the whole field, in the cloud's units")
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
                 "number of the first plot that is found; the others follow along the rows")
      ->check(CLI::Range(std::uint32_t{0}, std::uint32_t{1000000000}))
      ->excludes("--boxes");
  run.add_option("--numbering", arguments.numbering,
                 "zigzag: every row from its first column (default); serpentine: every other row "
                 "from its last")
      ->check(CLI::IsMember({"zigzag", "serpentine"}))
      ->excludes("--boxes");
  run.add_option("--first-corner", arguments.first_corner,
                 "sw, se, nw or ne: where row 1 and column 1 are, once plots are numbered or named "
                 "(default: sw)")
      ->check(CLI::IsMember({"sw", "se", "nw", "ne"}))
      ->excludes("--boxes");
  run.add_option("--plot-names", arguments.plot_names,
                 "table (CSV) with columns row, column, an id and others: the plots that are found "
                 "are called so, and keep the other columns")
      ->excludes("--boxes", "--first-number", "--numbering");
}

void declare_run(Program& program, RunArguments& arguments) {
  CLI::App& run =
      program.command("run", "Find the plots of a cloud and measure their crop heights.",
                      [&program, &arguments] { run_estimate(program, arguments); });
  arguments.command = &run;
  auto& options = arguments.options;
  run.add_option("CLOUD", options.cloud.files,
                 "PCD, PLY, LAS or text clouds, a scan folder (its cloud.pcd), or a folder of "
                 "tiles; several are read as one")
      ->required();
  run.add_option("-o,--output", options.output, "estimate folder to write")->required();
  run.add_option("--method", options.method,
                 "lattice: needs nothing but the cloud; dhami2020: the paper's pipeline, needs "
                 "--plots")
      ->check(CLI::IsMember(estimate::method_names()))
      ->capture_default_str();
  run.add_option("--crop-box", arguments.crop_box,
                 "x0,y0,x1,y1: use only the points in here, in the cloud's units (default: the "
                 "densely scanned field)")
      ->delimiter(',')
      ->expected(4);
  run.add_option(
         "--leave-out-class", options.cloud.leave_out_classes,
         "ASPRS classes of points to leave out, with commas: 3,4,5 is vegetation, 6 buildings")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 255));
  run.add_option(
         "--units", arguments.units,
         "of the cloud's coordinates, whatever its file states: m, ft, us-ft (default: what "
         "the file states, else metres)")
      ->check(CLI::IsMember({"m", "ft", "us-ft"}));
  run.add_option("--boxes", arguments.boxes,
                 "map of the plots (GeoJSON), in the cloud's units, or in longitude and latitude "
                 "where the cloud is in UTM or degrees: measure heights in its boxes, keep its ids "
                 "and attributes, search none");
  declare_names(run, arguments);
  run.add_option("--csv", arguments.csv,
                 "also write this table, a line a plot, for breeding databases: "
                 "observationunit_name, attributes, heights (metres)");
  run.add_option("--plots", arguments.plots,
                 "how many plots lie in the field, or in --learn-box (1 to 100000; dhami2020 needs "
                 "it)")
      ->excludes("--boxes");
  run.add_flag("--force", options.replace, "replace an estimate folder, a table that exists");
  declare_lattice(run, arguments);
  declare_dhami2020(run, arguments);
}

void say_boxes(const Program& program, const score::BoxScore& boxes) {
  program.say(formatted("plots    %zu of %zu found, %zu missed, %zu extra", boxes.found,
                        boxes.plots, boxes.missed, boxes.extra));
  if (boxes.found == 0) return;
  program.say(formatted(
      "boxes    IoU mean %.3f, median %.3f, least %.3f; centre %.3f m rms, heading %.2f deg rms",
      boxes.iou_mean, boxes.iou_median, boxes.iou_min, boxes.center_rmse_m,
      boxes.heading_rmse_rad * 180 / std::numbers::pi));
}

void say_errors(const Program& program, const std::vector<score::HeightScore>& heights) {
  program.say(formatted("%-12s %-15s %5s %7s %7s %7s %7s %7s %8s %5s", "height", "truth", "plots",
                        "without", "RMSE", "bias", "MAE", "SE", "R2", "r^2"));
  for (const score::HeightScore& height : heights) {
    program.say(formatted("%-12s %-15s %5zu %7zu %7.2f %+7.2f %7.2f %7.2f %8.2f %5.2f",
                          height.height.c_str(), height.truth.c_str(), height.plots, height.without,
                          100 * height.rmse_m, 100 * height.bias_m, 100 * height.mae_m,
                          100 * height.standard_error_m, height.r2, height.correlation2));
  }
  program.say(
      "RMSE, bias (estimate minus truth), MAE and SE (of the bias) in cm, over the plots "
      "found");
}

// What the estimate says of its own errors; nothing where it says nothing.
void say_trust(const Program& program, const std::vector<score::HeightScore>& heights) {
  std::vector<std::string> lines;
  for (const score::HeightScore& height : heights) {
    if (std::isnan(height.coverage95)) continue;
    lines.push_back(formatted("%-12s %-15s %7.1f %% %9zu %16zu (%.2f %%)", height.height.c_str(),
                              height.truth.c_str(), 100 * height.coverage95, height.flagged,
                              height.large_unflagged, 100 * height.large_unflagged_share));
  }
  if (lines.empty()) return;
  program.say("");
  program.say(formatted("%-12s %-15s %9s %9s %16s", "height", "truth", "in 95 %", "flagged",
                        "over 5 cm, none"));
  for (const std::string& line : lines) program.say(line);
  program.say(
      "in 95 %: truths inside the estimate's own intervals; over 5 cm, none: plots in error by "
      "more, unflagged");
}

void say_scores(const Program& program, const score::Scores& scores) {
  say_boxes(program, scores.boxes);
  if (scores.boxes.found == 0) return;
  const std::set<std::string> heights = score::estimated_heights(scores.field);
  std::vector<score::HeightScore> shown;
  for (const score::HeightScore& height : scores.heights) {
    if (program.common().verbosity > 0 ||
        score::heights_beside(height.truth, heights).contains(height.height))
      shown.push_back(height);
  }
  program.say("");
  say_errors(program, shown);
  say_trust(program, shown);
  if (shown.size() < scores.heights.size())
    program.say("Every height against every truth: -v, or scores.json");
}

void score_estimate(const Program& program, score::RunOptions options, const std::string& output) {
  if (!output.empty()) options.output = output;
  const score::Scores scores = score::run(options);
  say_scores(program, scores);
  if (options.output) program.say("written to " + options.output->string());
  program.result(score::to_json(scores));
}

void declare_score(Program& program, score::RunOptions& options, std::string& output) {
  CLI::App& score =
      program.command("score", "Compare an estimate with the truth.",
                      [&program, &options, &output] { score_estimate(program, options, output); });
  score
      .add_option(
          "EST", options.estimate,
          "estimate folder, or a GeoJSON file of plots with numbers height_<name>_m, metres")
      ->required();
  score
      .add_option("--truth", options.truth,
                  "farm folder, or a GeoJSON file of plots with numbers height_<name>_m, metres")
      ->required();
  score.add_option("-o,--output", output,
                   "folder to write scores.json and plots.csv to (default: write nothing)");
  score.add_option(
      "--min-iou", options.score.min_iou,
      "least overlap of a found plot's box with the true one, intersection over union");
  score.add_flag("--force", options.replace, "replace a scores folder that exists");
}

}  // namespace
}  // namespace plotscan

int main(int argc, char** argv) {
  plotscan::Program program("estimator", "Find plots in point clouds and measure crop heights.");
  plotscan::RunArguments run;
  plotscan::declare_run(program, run);
  plotscan::declare_info(program);
  plotscan::score::RunOptions score;
  std::string scores;
  plotscan::declare_score(program, score, scores);
  return program.run(argc, argv);
}
