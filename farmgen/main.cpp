// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/place_json.h"
#include "core/program.h"
#include "core/stopwatch.h"
#include "description/load_description.h"
#include "farm/summary.h"
#include "farm/true_heights.h"
#include "farmfolder/read_farm.h"
#include "lidar/make_farm.h"
#include "planting/generate.h"
#include "terrain/extent.h"

namespace {

using namespace plotscan;

constexpr const char* kFarmSeed = "seed of the farm (default: the description's, else 1)";

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> assignments;  // --set
  bool force = false;
};

nlohmann::json json_of(const farm::Spread& spread) {
  return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}};
}

nlohmann::json json_of(const std::vector<farm::CultivarSummary>& cultivars) {
  nlohmann::json list = nlohmann::json::array();
  for (const farm::CultivarSummary& cultivar : cultivars) {
    nlohmann::json entry = {
        {"accession_name", cultivar.name},           {"plots", cultivar.plots},
        {"plots_lodged", cultivar.lodged_plots},     {"plants", cultivar.plants},
        {"plants_missing", cultivar.missing_plants}, {"weeds", cultivar.weeds},
        {"height_mean_m", cultivar.height_mean_m},   {"height_max_m", cultivar.height_max_m},
        {"plants_per_m2", cultivar.plants_per_m2},   {"leaf_area_index", cultivar.leaf_area_index}};
    if (cultivar.trial > 0) entry["trial_number"] = cultivar.trial;
    list.push_back(std::move(entry));
  }
  return list;
}

nlohmann::json json_of(const farm::Farm& made, const farm::FarmSummary& summary) {
  nlohmann::json document = {{"name", made.name},
                             {"seed", made.seed},
                             {"terrain",
                              {{"size_m", {summary.terrain_size_m.x(), summary.terrain_size_m.y()}},
                               {"z_m", {summary.terrain_z_m.x(), summary.terrain_z_m.y()}},
                               {"triangles", summary.terrain_triangles}}},
                             {"models", summary.models},
                             {"plots", summary.plots},
                             {"trials", summary.trials},
                             {"field_size_m", {summary.field_size_m.x(), summary.field_size_m.y()}},
                             {"plants", summary.plants},
                             {"plant_triangles", summary.plant_triangles},
                             {"plant_height_m", json_of(summary.plant_height_m)},
                             {"plot_height_max_m", json_of(summary.plot_height_max_m)},
                             {"weeds", summary.weeds},
                             {"leaf_area_index", summary.leaf_area_index},
                             {"cultivars", json_of(summary.cultivars)}};
  if (made.anchor) document["anchor"] = anchor_json(*made.anchor);
  return document;
}

void say_cultivars(const Program& program, const std::vector<farm::CultivarSummary>& cultivars) {
  const bool several_trials = cultivars.back().trial > 0;
  const auto trial = [&](const std::string& text) {
    return several_trials ? fmt::format("{:>5}  ", text) : "";
  };
  std::size_t width = std::char_traits<char>::length("cultivar");
  for (const farm::CultivarSummary& cultivar : cultivars)
    width = std::max(width, cultivar.name.size());
  const auto padded = [&](const std::string& name) {
    return name + std::string(width - name.size(), ' ');
  };
  program.say(trial("trial") + padded("cultivar") +
              "  plots  lodged   plants  missing  weeds  mean m   max m  per m2   LAI");
  for (const farm::CultivarSummary& cultivar : cultivars) {
    program.say(trial(std::to_string(cultivar.trial)) + padded(cultivar.name) +
                fmt::format("  {:5}  {:6}  {:7}  {:7}  {:5}  {:6.3f}  {:6.3f}  {:6.1f}  {:4.2f}",
                            cultivar.plots, cultivar.lodged_plots, cultivar.plants,
                            cultivar.missing_plants, cultivar.weeds, cultivar.height_mean_m,
                            cultivar.height_max_m, cultivar.plants_per_m2,
                            cultivar.leaf_area_index));
  }
}

void say_summary(const Program& program, const farm::Farm& made, const farm::FarmSummary& summary) {
  const auto say_spread = [&](const char* label, const farm::Spread& spread) {
    program.say("{:15} {:.3f} / {:.3f} / {:.3f} m (min / mean / max)", label, spread.min,
                spread.mean, spread.max);
  };
  program.say("farm            {}, seed {}", made.name, made.seed);
  if (made.anchor) {
    program.say("anchor          latitude {:.8f}, longitude {:.8f} deg, {:.2f} m above WGS84",
                made.anchor->latitude_deg, made.anchor->longitude_deg, made.anchor->altitude_m);
  }
  program.say("terrain         {:.1f} x {:.1f} m, z {:.2f} to {:.2f} m, {} triangles",
              summary.terrain_size_m.x(), summary.terrain_size_m.y(), summary.terrain_z_m.x(),
              summary.terrain_z_m.y(), summary.terrain_triangles);
  program.say("plots           {}{} in a field of {:.1f} x {:.1f} m", summary.plots,
              summary.trials > 1 ? fmt::format(" of {} trials", summary.trials) : std::string(),
              summary.field_size_m.x(), summary.field_size_m.y());
  program.say("plants          {} of {} models, {} triangles when placed", summary.plants,
              summary.models, summary.plant_triangles);
  say_spread("plant heights", summary.plant_height_m);
  say_spread("plot maxima", summary.plot_height_max_m);
  if (summary.weeds > 0) program.say("weeds           {}", summary.weeds);
  program.say("leaf area index {:.2f} (area of the crop's leaves over the plots' area)",
              summary.leaf_area_index);
  if (!summary.cultivars.empty()) say_cultivars(program, summary.cultivars);
}

farm::Farm generate_from(const Program& program, const Arguments& arguments) {
  const planting::FarmDescription description = description::load_description(
      found_or_shipped(arguments.input, "worlds"), arguments.assignments);
  const CommonOptions& common = program.common();
  return planting::generate(
      description, common.seed_given ? common.seed : description.seed.value_or(common.seed));
}

void say_notes(const Program& program, const farm::Farm& made) {
  for (const farm::PlantModel& model : made.models)
    for (const std::string& note : model.notes) program.say("note: " + note);
}

void run_generate(const Program& program, const Arguments& arguments) {
  const Stopwatch watch;
  const CommonOptions& common = program.common();
  const farm::Farm made =
      lidar::make_farm(found_or_shipped(arguments.input, "worlds"), arguments.output,
                       {.overrides = arguments.assignments,
                        .seed = common.seed_given ? std::optional(common.seed) : std::nullopt,
                        .threads = common.threads,
                        .replace = arguments.force},
                       program.progress("writing"));
  if (common.json) {
    nlohmann::json document = json_of(made, farm::summarise(made));
    document["folder"] = arguments.output;
    document["seconds"] = watch.seconds();
    program.result(document);
  }
  const Eigen::Vector3d size_m = terrain::extent_of(made.terrain).sizes();
  const auto weeds = std::ranges::count(made.plants, farm::PlantKind::weed, &farm::Plant::kind);
  program.say("{}: {} plots, {} plants on {:.1f} x {:.1f} m, seed {}, in {:.2f} s",
              arguments.output, made.plots.size(),
              made.plants.size() - static_cast<std::size_t>(weeds), size_m.x(), size_m.y(),
              made.seed, watch.seconds());
  say_notes(program, made);
}

void run_info(const Program& program, const Arguments& arguments) {
  const farm::Farm read = farmfolder::read_farm(arguments.input);
  const farm::FarmSummary summary = farm::summarise(read);
  program.result(json_of(read, summary));
  say_summary(program, read, summary);
}

void run_check(const Program& program, const Arguments& arguments) {
  const farm::Farm made = generate_from(program, arguments);
  const farm::FarmSummary summary = farm::summarise(made);
  program.result(json_of(made, summary));
  program.say(arguments.input + " is sound; it makes");
  say_summary(program, made, summary);
  say_notes(program, made);
}

void add_farm_options(CLI::App& command, Arguments& arguments) {
  command
      .add_option("FARM", arguments.input,
                  "farm description (YAML), or the name of a shipped one, such as paper_half")
      ->required();
  command
      .add_option("--set", arguments.assignments,
                  "key=value in place of the description's, as in terrain.relief_m=0.5 or "
                  "plots.rows.0.plots=5; may be repeated")
      ->expected(1)
      ->take_all();
}

}  // namespace

int main(int argc, char** argv) {
  Program program("farmgen", "Generate virtual phenotyping farms with known truth.");
  Arguments arguments;

  CLI::App& generate = program.command(
      "generate", "Make a farm folder from a description and a seed.",
      [&] { run_generate(program, arguments); }, {.seed = kFarmSeed, .threads = true});
  add_farm_options(generate, arguments);
  generate.add_option("-o,--output", arguments.output, "farm folder to write")->required();
  generate.add_flag("--force", arguments.force, "replace a farm that is already there");

  CLI::App& info = program.command("info", "Print what a farm folder holds.",
                                   [&] { run_info(program, arguments); });
  info.add_option("FOLDER", arguments.input, "farm folder written by generate")->required();

  CLI::App& check = program.command("check", "Check a farm description, and print what it makes.",
                                    [&] { run_check(program, arguments); }, {.seed = kFarmSeed});
  add_farm_options(check, arguments);

  declare_export(program);
  declare_plant(program);
  return program.run(argc, argv);
}
