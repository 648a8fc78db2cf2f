// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>

#include <fmt/core.h>

#include "commands.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/temporary_path.h"
#include "core/text.h"
#include "crop/grow.h"
#include "mesh/measure.h"
#include "mesh/obj.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;

struct PlantArguments {
  crop::GrowOptions options;
  std::string detail = "scan";
  std::string output;
  bool force = false;
};

void require_free(const fs::path& path) {
  if (fs::exists(path)) throw InputError(path, "exists; --force replaces it");
}

bool have_same_bytes(const fs::path& a, const fs::path& b) {
  return fs::is_regular_file(b) && file_hash(a) == file_hash(b);
}

// Moves files of these names to another folder. If one cannot be moved, removes the new ones.
void place(std::span<const fs::path> names, const fs::path& from, const fs::path& to) {
  std::vector<fs::path> anew;
  for (const fs::path& name : names) {
    std::error_code error;
    const bool was_there = fs::exists(to / name, error);
    fs::rename(from / name, to / name, error);
    if (error) {
      std::error_code ignored;
      for (const fs::path& file : anew) fs::remove(file, ignored);
      throw WriteError(to / name, error.value());
    }
    if (!was_there) anew.push_back(to / name);
  }
}

// The mesh, its materials and their pictures, written beside their places and renamed when they are
// whole, the mesh last: where it is, all is. Files with the same bytes, as a killed run may have
// left, are no obstacle.
void write_mesh(const fs::path& output, const mesh::Mesh& mesh, bool replace) {
  if (!fs::is_directory(fs::absolute(output).parent_path()))
    throw InputError(output, "cannot be created: there is no such folder");
  const TemporaryPath partial(partial_path(output));
  std::error_code error;
  fs::create_directory(partial.path(), error);
  if (error) throw WriteError(output, error.value());
  mesh::write_obj(partial.path() / output.filename(), mesh);
  std::vector<fs::path> names;
  for (const auto& file : fs::directory_iterator(partial.path())) {
    names.push_back(file.path().filename());
    const fs::path place = output.parent_path() / names.back();
    if (!replace && !have_same_bytes(file.path(), place)) require_free(place);
  }
  std::partition(names.begin(), names.end(),
                 [&](const fs::path& name) { return name != output.filename(); });
  place(names, partial.path(), output.parent_path());
}

void run_plant(const Program& program, const PlantArguments& arguments) {
  const fs::path output = arguments.output;
  if (output.extension() != ".obj") throw InputError(output, "does not end in .obj");
  if (!arguments.force) require_free(output);
  crop::GrowOptions options = arguments.options;
  options.detail = arguments.detail == "light" ? crop::Detail::light : crop::Detail::scan;
  const mesh::Mesh mesh = crop::grow(options, program.common().seed);
  write_mesh(output, mesh, arguments.force);
  const crop::StageFacts facts =
      crop::stage_facts(options.crop, options.stage, options.cultivar_file);
  const double height_m = mesh::mesh_height(mesh);
  const double leaf_area_m2 = mesh::ScaledArea::of_leaves(mesh).at();
  program.result({{"mesh", arguments.output},
                  {"crop", options.crop},
                  {"stage", facts.stage.name},
                  {"detail", arguments.detail},
                  {"height_m", height_m},
                  {"leaf_area_m2", leaf_area_m2},
                  {"area_m2", mesh::ScaledArea(mesh).at()},
                  {"vertices", mesh.vertices.size()},
                  {"triangles", mesh.triangles.size()}});
  program.say("{}: {} at {}, height {:.3f} m, leaf area {:.4f} m2, {} triangles", arguments.output,
              options.crop, facts.stage.name, height_m, leaf_area_m2, mesh.triangles.size());
  program.say(
      "a plot of {:g} plants per m2 at {}: height {:g} to {:g} m, leaf area index {:g} to {:g}",
      facts.plants_per_m2, facts.stage.name, facts.stage.height_m.low, facts.stage.height_m.high,
      facts.stage.leaf_area_index.low, facts.stage.leaf_area_index.high);
}

std::string stages_help(const crop::Cultivar& cultivar) {
  std::string text;
  for (const crop::Stage& stage : cultivar.stages) {
    const char* const mark = stage.name == cultivar.default_stage ? " (default)" : "";
    text += fmt::format("  {:9} {}{}\n", stage.name, stage.meaning, mark);
  }
  return text;
}

std::string keys_help(const crop::Cultivar& cultivar) {
  std::string text;
  for (const crop::Parameter& parameter : cultivar.parameters) {
    const std::string value = parameter.by_stage ? "by stage" : format_number(parameter.value);
    text += fmt::format("  {:22} {:8} {:6} {:14} {}\n", parameter.name, value, parameter.unit,
                        parameter.range.text(), parameter.meaning);
  }
  return text;
}

std::string text_of(const crop::Cultivar& cultivar) {
  return cultivar.crop + " (" + cultivar.species + ")\nStages:\n" + stages_help(cultivar) +
         "Keys of --set with default, unit and range:\n" + keys_help(cultivar);
}

nlohmann::json json_of(const crop::Parameter& parameter) {
  nlohmann::json document = {{"key", parameter.name},
                             {"unit", parameter.unit},
                             {"range", {parameter.range.low, parameter.range.high}},
                             {"meaning", parameter.meaning}};
  if (!parameter.by_stage) document["value"] = parameter.value;
  return document;
}

nlohmann::json json_of(const crop::Cultivar& cultivar) {
  nlohmann::json document = {{"crop", cultivar.crop},
                             {"species", cultivar.species},
                             {"default_stage", cultivar.default_stage},
                             {"stages", nlohmann::json::array()},
                             {"parameters", nlohmann::json::array()}};
  for (const crop::Stage& stage : cultivar.stages)
    document["stages"].push_back(
        {{"stage", stage.name}, {"meaning", stage.meaning}, {"values", stage.values}});
  for (const crop::Parameter& parameter : cultivar.parameters)
    document["parameters"].push_back(json_of(parameter));
  return document;
}

// --list: of one crop, or of all where none is named.
void list(const Program& program, const crop::GrowOptions& options) {
  std::string text;
  nlohmann::json document = nlohmann::json::array();
  for (const std::string& name : crop::crops()) {
    if (!options.crop.empty() && name != options.crop) continue;
    const crop::Cultivar cultivar = crop::cultivar(name, options.cultivar_file);
    text += (text.empty() ? "" : "\n") + text_of(cultivar);
    document.push_back(json_of(cultivar));
  }
  program.result(document);
  if (!program.common().json) std::cout << text;
}

}  // namespace

void declare_plant(Program& program) {
  const auto arguments = std::make_shared<PlantArguments>();
  CLI::App& plant = program.command("plant", "Grow a plant mesh from parameters and a seed.",
                                    [&program, arguments] { run_plant(program, *arguments); },
                                    {.seed = "seed of the plant"});
  plant.add_option("CROP", arguments->options.crop, "one of " + joined(crop::crops(), ", "))
      ->required()
      ->check(CLI::IsMember(crop::crops()));
  plant.add_option("--stage", arguments->options.stage,
                   "growth stage, as --list names them (default: the crop's own)");
  plant.add_option("--cultivar", arguments->options.cultivar_file,
                   "YAML file of a cultivar, over the crop's own");
  plant
      .add_option("--set", arguments->options.assignments,
                  "key=value of a parameter, as --list names them; may be repeated")
      ->expected(1)
      ->take_all();
  plant.add_option("--detail", arguments->detail, "scan: every leaf's shape; light: few triangles")
      ->check(CLI::IsMember({"scan", "light"}));
  plant.add_flag("--textured", arguments->options.textured,
                 "pictures of the organs' surfaces in place of plain colours");
  plant.add_option("-o,--output", arguments->output, "mesh to write (OBJ, metres, z up)")
      ->required();
  plant.add_flag("--force", arguments->force, "replace a mesh that is already there");
  const auto print_list = [&program, &plant, options = &arguments->options] {
    // It is declared after --list, and would be read after it.
    if (plant.count("--json") > 0) plant.get_option("--json")->run_callback();
    list(program, *options);
    throw CLI::Success();
  };
  plant.add_flag_callback("--list", print_list,
                          "only print the crop's stages and its parameters with defaults, units "
                          "and ranges, of --cultivar if given; without CROP, those of all crops");
}

}  // namespace plotscan
