// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "commands.h"
#include "core/stopwatch.h"
#include "farmfolder/read_farm.h"
#include "gazebo/export_world.h"

namespace plotscan {
namespace {

struct ExportArguments {
  std::string farm;
  std::string output;
  std::string gazebo;
  std::string merge = "plot";
  std::string lod = "light";
  std::string collision = "none";
  bool drone = false;
  std::string lidar = "gpu";
  bool force = false;
};

const std::map<std::string, gazebo::Gazebo> kGazebos = {{"classic", gazebo::Gazebo::classic},
                                                        {"sim", gazebo::Gazebo::sim}};
const std::map<std::string, gazebo::Merge> kMerges = {
    {"plot", gazebo::Merge::plot}, {"row", gazebo::Merge::row}, {"none", gazebo::Merge::none}};
const std::map<std::string, gazebo::Detail> kDetails = {{"light", gazebo::Detail::light},
                                                        {"scan", gazebo::Detail::scan}};
const std::map<std::string, gazebo::Collision> kCollisions = {{"none", gazebo::Collision::none},
                                                              {"box", gazebo::Collision::box},
                                                              {"mesh", gazebo::Collision::mesh}};
const std::map<std::string, gazebo::Lidar> kLidars = {{"gpu", gazebo::Lidar::gpu},
                                                      {"cpu", gazebo::Lidar::cpu}};

template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::string& text, const std::map<std::string, Value>& choices) {
  return command.add_option(name, value, text)->check(CLI::IsMember(&choices));
}

Manifest manifest_of(const ExportArguments& arguments) {
  return {.command = "farmgen export",
          .options = {{"gazebo", arguments.gazebo},
                      {"merge", arguments.merge},
                      {"lod", arguments.lod},
                      {"collision", arguments.collision},
                      {"drone", arguments.drone},
                      {"lidar", arguments.lidar}},
          .inputs = {std::filesystem::path(arguments.farm) / "manifest.json"}};
}

void run_export(const Program& program, const ExportArguments& arguments) {
  const Stopwatch watch;
  const gazebo::ExportSummary summary =
      gazebo::export_world(farmfolder::read_farm(arguments.farm), arguments.farm, arguments.output,
                           {.gazebo = kGazebos.at(arguments.gazebo),
                            .merge = kMerges.at(arguments.merge),
                            .lod = kDetails.at(arguments.lod),
                            .collision = kCollisions.at(arguments.collision),
                            .drone = arguments.drone,
                            .lidar = kLidars.at(arguments.lidar),
                            .threads = program.common().threads,
                            .replace = arguments.force},
                           manifest_of(arguments), program.progress("exporting"));
  const gazebo::EntityCounts& counts = summary.counts;
  nlohmann::json result = gazebo::counts_json(counts);
  result.update({{"folder", arguments.output},
                 {"plants", summary.plants},
                 {"bytes", summary.bytes},
                 {"seconds", watch.seconds()}});
  program.result(result);
  program.say(
      "{}: {} plants merged by {}, {:.1f} MB, {} triangles, {} models, {} "
      "links, {} visuals, {} collisions, in {:.2f} s",
      arguments.output, summary.plants, arguments.merge, static_cast<double>(summary.bytes) * 1e-6,
      counts.triangles, counts.models, counts.links, counts.visuals, counts.collisions,
      watch.seconds());
  program.say("README.md in it tells how it is opened");
}

}  // namespace

void declare_export(Program& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App& command = program.command("export", "Write a farm folder as a world for Gazebo.",
                                      [&program, arguments] { run_export(program, *arguments); },
                                      {.threads = true});
  command.add_option("FARM", arguments->farm, "farm folder written by generate")->required();
  add_choice(
      command, "--gazebo", arguments->gazebo,
      "classic: Gazebo Classic 9 and 11, SDF 1.6; sim: Gazebo Sim, Fortress to Jetty, SDF 1.9",
      kGazebos)
      ->required();
  command.add_option("-o,--output", arguments->output, "folder to write")->required();
  add_choice(
      command, "--merge", arguments->merge,
      "what becomes one model: the plants of a plot (a mesh a material), of a row, or each plant "
      "(slow to load where there are thousands)",
      kMerges);
  add_choice(command, "--lod", arguments->lod,
             "light: plants of at most about 300 triangles; scan: the meshes that lidarsim scans",
             kDetails);
  add_choice(
      command, "--collision", arguments->collision,
      "of the plants: none, a box around each plot's canopy (or each plant), or their meshes; "
      "the terrain always collides",
      kCollisions);
  command.add_flag("--drone", arguments->drone,
                   "a quadrotor with a VLP-16, and a script that flies it along a trajectory.csv");
  add_choice(command, "--lidar", arguments->lidar,
             "the drone's in Gazebo Classic: gpu sees what is drawn and needs a display; cpu sees "
             "collisions (--collision mesh or box) and needs none",
             kLidars);
  command.add_flag("--force", arguments->force, "replace a world that is already there");
}

}  // namespace plotscan
