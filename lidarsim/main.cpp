// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "lidar/fly_place.h"
#include "lidar/fly_settings.h"
#include "record/scan_formats.h"

namespace {

using namespace plotscan;

struct Arguments {
  std::string place;  // a farm's folder or a world's file
  std::string scan;
  std::string part;
  const CLI::App* fly = nullptr;
  lidar::FlyPlaceOptions options;
};

void report(const Program& program, const Arguments& arguments, const lidar::PlaceScan& scanned,
            double elapsed_s) {
  const auto& [summary, notes] = scanned;
  const auto bytes =
      std::filesystem::file_size(std::filesystem::path(arguments.scan) / "cloud.pcd");
  const double shots_a_second = static_cast<double>(summary.shots) / elapsed_s;
  program.result({{"scan", arguments.scan},
                  {"duration_s", summary.duration_s},
                  {"shots", summary.shots},
                  {"points", summary.points},
                  {"shots_per_second", shots_a_second},
                  {"cloud_bytes", bytes},
                  {"notes", notes},
                  {"seconds", elapsed_s}});
  for (const std::string& note : notes) program.say("note: " + note);
  program.say("{}: a flight of {:.1f} s, {:.2f} million shots, {:.2f} million points",
              arguments.scan, summary.duration_s, 1e-6 * static_cast<double>(summary.shots),
              1e-6 * static_cast<double>(summary.points));
  program.say("cloud.pcd {:.1f} MB, simulated in {:.2f} s ({:.1f} million shots a second)",
              1e-6 * static_cast<double>(bytes), elapsed_s, 1e-6 * shots_a_second);
}

void require_swaying(const CLI::App& fly, const lidar::FlyOptions& options, bool is_farm) {
  if (is_farm && options.wind_acts_on != "drone") return;
  for (const std::string flag : {"--sway", "--sway-frequency", "--sway-swing"}) {
    if (fly.count(flag) > 0)
      throw InputError(flag + (is_farm
                                   ? " is of plants, and --wind-acts-on drone leaves them at rest"
                                   : " is of a farm's plants; those of an SDF world stand still"));
  }
}

void require_drift(const CLI::App& fly, const std::string& time,
                   const std::vector<std::string>& drifts) {
  const auto is_given = [&](const std::string& flag) { return fly.count(flag) > 0; };
  if (is_given(time) && !is_given("--pose-error") && std::ranges::none_of(drifts, is_given))
    throw InputError(time + " is of a drift, and none is given: " + joined(drifts, ", ") +
                     " or --pose-error");
}

// Throws InputError on options that would change nothing beside the others.
void require_effect(const CLI::App& fly, const lidar::FlyOptions& options, bool is_farm) {
  if (fly.count("--spacing") > 0 && options.pattern == "single")
    throw InputError("--spacing is between neighbouring strips; --pattern single flies only one");
  require_swaying(fly, options, is_farm);
  const CLI::Option& wind = *fly.get_option("--wind");
  for (const CLI::Option* option : fly.get_options()) {
    if (option->get_group() == wind.get_group() && option->count() > 0 && wind.count() == 0)
      throw InputError(option->get_name() + " needs a wind: --wind, metres per second");
  }
  require_drift(fly, "--position-drift-time", {"--position-drift", "--height-drift"});
  require_drift(fly, "--attitude-drift-time", {"--tilt-drift", "--heading-drift"});
}

void run_fly(const Program& program, Arguments& arguments) {
  const Stopwatch watch;
  require_effect(*arguments.fly, arguments.options.flight,
                 std::filesystem::is_directory(arguments.place));
  arguments.place = found_place(arguments.place, "worlds");
  lidar::FlyOptions& options = arguments.options.flight;
  options.seed = program.common().seed;
  options.threads = program.common().threads;
  if (!arguments.part.empty()) options.part = lidar::flight_part(arguments.part);
  const lidar::PlaceScan scanned = lidar::fly_place(
      arguments.place, arguments.scan, arguments.options, program.progress("scanning"));
  report(program, arguments, scanned, watch.seconds());
}

template <class Setting>
CLI::Option* add_setting(CLI::App& fly, const lidar::FlySetting& setting, const Setting& value,
                         lidar::FlyOptions& options) {
  return fly.add_option(setting.flag, value.of(options), setting.help);
}

// --help and completions read the choices from the type's name; the values are checked with
// FlyOptions as a whole.
CLI::Option* add_setting(CLI::App& fly, const lidar::FlySetting& setting,
                         const lidar::TextSetting& value, lidar::FlyOptions& options) {
  CLI::Option* option = fly.add_option(setting.flag, value.of(options), setting.help);
  if (!value.choices.empty()) option->type_name("TEXT:{" + joined(value.choices, ",") + "}");
  return option;
}

CLI::Option* add_setting(CLI::App& fly, const lidar::FlySetting& setting,
                         const lidar::VectorSetting& value, lidar::FlyOptions& options) {
  const auto read = [&vector = value.of(options)](const std::vector<double>& numbers) {
    vector = Eigen::Vector3d(numbers.at(0), numbers.at(1), numbers.at(2));
  };
  const Eigen::Vector3d& usual = value.of(options);
  return fly.add_option_function<std::vector<double>>(setting.flag, read, setting.help)
      ->delimiter(',')
      ->expected(3)
      ->default_str(fmt::format("{:g},{:g},{:g}", usual.x(), usual.y(), usual.z()));
}

void add_settings(CLI::App& fly, lidar::FlyOptions& options, CLI::Option& flight,
                  CLI::Option& waypoints) {
  for (const lidar::FlySetting& setting : lidar::fly_settings()) {
    CLI::Option* option =
        std::visit([&](const auto& value) { return add_setting(fly, setting, value, options); },
                   setting.value);
    option->group(setting.group);
    if (setting.plans != lidar::Plan::none) option->excludes(&flight);
    if (setting.plans == lidar::Plan::strips) option->excludes(&waypoints);
  }
}

void add_options(CLI::App& fly, Arguments& arguments) {
  lidar::FlyOptions& options = arguments.options.flight;
  fly.add_option("FARM|WORLD.sdf", arguments.place,
                 "farm folder, as farmgen writes it, or the file of any SDF world or model")
      ->required();
  fly.add_option("-o,--output", arguments.scan, "scan folder to write")->required();
  fly.add_option("--resource-path", arguments.options.resource_paths,
                 "folder that holds models of the world, searched before the world's own and those "
                 "of GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH; may be repeated");
  auto* flight =
      fly.add_option("--flight", options.flight,
                     "trajectory to fly in place of planned strips: TUM text (t x y z qx qy qz qw; "
                     "seconds, metres) or a scan's trajectory.csv; flown as it is, "
                     "wind does not move it");
  auto* waypoints = fly.add_option("--waypoints", options.waypoints,
                                   "YAML file of waypoints to fly in place of planned strips "
                                   "(docs/flight.md)")
                        ->excludes(flight);
  add_settings(fly, options, *flight, *waypoints);
  arguments.fly = &fly;
  fly.add_option("--format", options.formats,
                 "also write the scan as " + alternatives(record::further_formats()) +
                     " (docs/formats.md) beside cloud.pcd; separated by commas, or repeated")
      ->delimiter(',')
      ->allow_extra_args(false);
  fly.add_option("--part", arguments.part,
                 "I/N: scan the I-th of N equally long parts of the flight, which lidarsim join "
                 "joins (docs/scale.md)");
  fly.add_flag("--force", options.replace, "replace an existing scan folder");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("lidarsim", "Scan virtual farms and SDF worlds with a simulated LiDAR drone.");
  Arguments arguments;
  CLI::App& fly =
      program.command("fly", "Fly over a farm or an SDF world and write the scan.",
                      [&] { run_fly(program, arguments); },
                      {.seed = "seed of range noise, wind and pose errors", .threads = true});
  add_options(fly, arguments);
  declare_convert(program);
  declare_join(program);
  declare_sensors(program);
  declare_view(program);
  return program.run(argc, argv);
}
