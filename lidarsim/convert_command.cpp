// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "record/convert.h"
#include "record/formats.h"

namespace plotscan {
namespace {

struct ConvertArguments {
  std::string in;
  std::string out;
  record::ConvertOptions options;
  record::FlightOptions flight;
  std::vector<double> mount_deg = {0, 90, 0};
  std::vector<CLI::Option*> of_flight;  // the options that tell of a flight
};

void run_convert(const Program& program, ConvertArguments& arguments) {
  const Stopwatch watch;
  record::FlightOptions& flight = arguments.flight;
  flight.mount_rpy_deg = Eigen::Vector3d(arguments.mount_deg.data());
  for (const CLI::Option* option : arguments.of_flight)
    if (option->count() > 0) arguments.options.flight = flight;
  const record::ConvertSummary summary = record::convert(
      arguments.in, arguments.out, arguments.options, program.progress("converting"));
  const auto bytes = std::filesystem::file_size(arguments.out);
  program.result({{"file", arguments.out},
                  {"points", summary.points},
                  {"poses", summary.poses},
                  {"without_place", summary.without_place},
                  {"notes", summary.notes},
                  {"bytes", bytes},
                  {"seconds", watch.seconds()}});
  const bool poses = summary.poses > 0;
  program.say("{}: {} {}, {:.1f} MB", arguments.out, poses ? summary.poses : summary.points,
              poses ? "poses" : "points", 1e-6 * static_cast<double>(bytes));
  if (summary.without_place > 0)
    program.say(
        "note: {} more points have no place: they are not finite, or no pose "
        "or transform covers their time",
        summary.without_place);
  for (const std::string& note : summary.notes) program.say("note: " + note);
}

void add_flight_options(CLI::App& convert, ConvertArguments& arguments) {
  arguments.of_flight = {
      convert.add_option(
          "--trajectory", arguments.flight.trajectory,
          "of a bare cloud or a pcap: where the drone was, TUM text or trajectory.csv, in the "
          "cloud's frame and time"),
      convert.add_option(
          "--sensor", arguments.flight.sensor,
          "of a bare cloud or a pcap: a shipped sensor's name or the file of your own"),
      convert.add_option("--spin", arguments.flight.spin_hz,
                         "of a bare cloud or a pcap: turns of the sensor a second; by default its "
                         "own, or what the "
                         "packets show"),
      convert
          .add_option(
              "--mount", arguments.mount_deg,
              "of a bare cloud or a pcap: the sensor in the body's frame, roll,pitch,yaw in "
              "degrees")
          ->delimiter(',')
          ->expected(3)
          ->default_str("0,90,0"),
      convert.add_option("--start", arguments.flight.start_utc,
                         "of a bare cloud: when its time 0 was, UTC; else as it says itself")};
}

std::string readable_recordings() {
  return joined(record::extensions_of([](const record::Format& format) {
                  return format.open != nullptr && format.is_recording;
                }),
                ", ");
}

// "of a PCD cloud: binary (default), compressed or ascii; of ..."
std::string encodings_of_formats() {
  std::vector<std::string> texts;
  for (const record::Format& format : record::formats()) {
    std::vector<std::string> encodings = format.encodings;
    if (encodings.empty()) continue;
    encodings.front() += " (default)";
    texts.push_back("of a " + format.name + ": " + alternatives(encodings));
  }
  return joined(texts, "; ");
}

}  // namespace

void declare_convert(Program& program) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& convert =
      program.command("convert", "Convert scans, clouds, recordings and trajectories.",
                      [&program, arguments] { run_convert(program, *arguments); });
  convert
      .add_option("IN", arguments->in,
                  "scan folder, cloud (" + record::readable_clouds() + "), recording (" +
                      readable_recordings() + "), or trajectory (TUM text, trajectory.csv)")
      ->required();
  convert
      .add_option("OUT", arguments->out,
                  "file to write; its extension says the format (docs/formats.md)")
      ->required();
  convert.add_option("--topic", arguments->options.topic,
                     "of a bag or MCAP: the topic of its clouds (default: /velodyne_points, or "
                     "the only one)");
  convert.add_option("--encoding", arguments->options.write.encoding,
                     encodings_of_formats() + "; compressing keeps the whole cloud in memory");
  convert.add_option("--crs", arguments->options.write.crs,
                     "of LAS: local (default), the world frame, or utm, the UTM zone of a farm "
                     "with an anchor");
  add_flight_options(convert, *arguments);
  convert.add_flag("--force", arguments->options.replace, "replace an existing file");
}

}  // namespace plotscan
