// SPDX-License-Identifier: Apache-2.0
#include "record/join_scans.h"

#include <algorithm>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/contains.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "record/scan_formats.h"
#include "scan/cloud_writer.h"
#include "scan/point_reader.h"
#include "sensor/sensor.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* kFlyCommand = "lidarsim fly";
// Files that are the same in all parts of a flight.
constexpr const char* kCommonFiles[] = {"trajectory.csv", "poses.csv", "sensor.yaml"};

struct Part {
  fs::path folder;
  int number = 0;
  int of = 0;
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
  json flight;  // the manifest without what differs from part to part
};

json hashes_of_common_files(const json& manifest) {
  json hashes = json::object();
  for (const json& output : manifest.at("outputs")) {
    const std::string file = output.at("file");
    if (contains(kCommonFiles, file)) hashes[file] = output.at("hash");
  }
  return hashes;
}

// A flight in one part, --part 1/1, is a whole scan.
Part read_part(const fs::path& folder, bool only_one) {
  json manifest = read_manifest(folder);
  try {
    json& options = manifest.at("options");
    if (only_one && !options.contains("part")) options["part"] = {1, 1};
    if (manifest.at("command") != kFlyCommand || !options.contains("part"))
      throw InputError(folder, "is no part of a flight; lidarsim fly --part I/N makes one");
    Part part{.folder = folder,
              .number = options["part"].at(0),
              .of = options["part"].at(1),
              .shots = manifest.at("results").at("shots"),
              .points = manifest.at("results").at("points"),
              .flight = {}};
    options.erase("part");
    options.erase("formats");  // of a whole scan; JoinOptions says which are written
    part.flight = {{"plotscan", manifest.at("plotscan")},
                   {"seed", manifest.at("seed")},
                   {"options", options},
                   {"inputs", manifest.at("inputs")},
                   {"duration_s", manifest.at("results").at("duration_s")},
                   {"files", hashes_of_common_files(manifest)}};
    return part;
  } catch (const json::exception& error) {
    throw InputError(folder / "manifest.json", "is not lidarsim fly's: " + json_reason(error));
  }
}

void require_one_flight(const Part& first, const Part& part) {
  const auto differs = [&](const char* what) {
    throw InputError(part.folder, "is of another flight than {}: {} differ", first.folder.string(),
                     what);
  };
  if (part.of != first.of) differs("the numbers of parts");
  for (const auto& [key, what] :
       {std::pair{"plotscan", "the versions of plotscan"}, std::pair{"seed", "the seeds"},
        std::pair{"options", "the options"}, std::pair{"inputs", "the files that were flown over"},
        std::pair{"duration_s", "the durations"}, std::pair{"files", "the trajectories"}}) {
    if (part.flight.at(key) != first.flight.at(key)) differs(what);
  }
}

// The parts in order. Throws InputError unless they are all parts of one flight, each once.
std::vector<Part> read_parts(const std::vector<fs::path>& folders) {
  if (folders.empty()) throw InputError("no parts of a flight are given");
  std::vector<Part> parts;
  for (const fs::path& folder : folders) {
    parts.push_back(read_part(folder, folders.size() == 1));
    require_one_flight(parts.front(), parts.back());
    require_unchanged(folder, "");
  }
  std::ranges::sort(parts, {}, &Part::number);
  const auto name = [&](std::size_t number) {
    return "part " + std::to_string(number) + "/" + std::to_string(parts.front().of);
  };
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].number == parts[i - 1].number)
      throw InputError(parts[i].folder, "is {}, as is {}",
                       name(static_cast<std::size_t>(parts[i].number)),
                       parts[i - 1].folder.string());
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(parts.front().of); ++i) {
    if (i >= parts.size() || static_cast<std::size_t>(parts[i].number) != i + 1)
      throw InputError(name(i + 1) + " of the flight is missing");
  }
  return parts;
}

std::uint64_t write_cloud(const std::vector<Part>& parts, const fs::path& file,
                          const ProgressReport& progress) {
  std::uint64_t points = 0;
  for (const Part& part : parts) points += part.points;
  scan::PcdWriter cloud(file);
  for (const Part& part : parts) {
    if (part.points == 0) continue;  // read_points refuses a cloud without points
    const fs::path from = part.folder / "cloud.pcd";
    scan::read_points(
        from, scan::read_cloud_info(from), [&](std::span<const scan::LabelledPoint> read) {
          cloud.write(read);
          if (progress) progress(static_cast<double>(cloud.points()) / static_cast<double>(points));
        });
  }
  cloud.close();
  return cloud.points();
}

}  // namespace

JoinSummary join_scans(const std::vector<fs::path>& folders, const fs::path& scan,
                       const JoinOptions& options, const ProgressReport& progress) {
  const std::vector<Part> parts = read_parts(folders);
  const Part& first = parts.front();
  require_formats(options.formats, sensor::load_sensor((first.folder / "sensor.yaml").string()));
  OutputFolder output(scan, options.replace, kFlyCommand, folders);
  JoinSummary summary{.parts = parts.size()};
  for (const Part& part : parts) summary.shots += part.shots;
  summary.points = write_cloud(parts, output.path() / "cloud.pcd", progress);
  for (const char* file : kCommonFiles) fs::copy_file(first.folder / file, output.path() / file);
  Manifest manifest{.command = kFlyCommand,
                    .seed = first.flight.at("seed"),
                    .options = first.flight.at("options"),
                    .results = {{"duration_s", first.flight.at("duration_s")},
                                {"shots", summary.shots},
                                {"points", summary.points}}};
  manifest.earlier_inputs = first.flight.at("inputs");
  if (!options.formats.empty()) manifest.options["formats"] = options.formats;
  finish_scan(output.path(), manifest, options.formats);
  output.commit();
  return summary;
}

}  // namespace plotscan::record
