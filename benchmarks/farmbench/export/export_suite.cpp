// SPDX-License-Identifier: Apache-2.0
#include "farmbench/export/export_suite.h"

#include <chrono>
#include <string_view>

#include <unistd.h>

#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "core/text_file.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/markdown.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* kExportCommand = "farmbench export";
constexpr double kExportFlown = 0.8;  // how far a field is when it has been flown

const json& heights_asked() {
  static const json heights = {
      {"height_mean_m", "mean height of its plants"},
      {"height_max_m", "height of its highest plant"},
      {"height_p50_m", "median of its plants' heights"},
      {"height_p90_m", "90th percentile of its plants' heights"},
      {"height_p95_m", "95th percentile of its plants' heights"},
      {"height_p99_m", "99th percentile of its plants' heights"},
      {"canopy_p95_m", "height that 5 % of its area reach, bare soil included"},
      {"canopy_p99_m", "height that 1 % of its area reach, bare soil included"}};
  return heights;
}

constexpr std::string_view kFiles =
    "| file | holds |\n| --- | --- |\n"
    "| `cloud.pcd`, `cloud.las` | the points, whichever of the two were asked for |\n"
    "| `flight.pcap` | the sensor's packets, where they were asked for |\n"
    "| `poses.csv` | where the drone reported to be: `t_s,x_m,y_m,z_m,qx,qy,qz,qw` |\n"
    "| `sensor.yaml`, `flight.json` | the sensor and how it was mounted and set |\n"
    "| `boxes.csv`, `boxes.geojson` | the plots' boxes, where they are given |\n";

constexpr std::string_view kFrame =
    "Coordinates are metres in a local frame, x east, y north, z up; times are seconds from the "
    "flight's start. A box is its centre, width, length and heading: the direction of the length, "
    "counter-clockwise from x, degrees.\n";

constexpr std::string_view kHandIn =
    "Hand in a folder with\n\n"
    "- `submission.json`: `{\"method\": \"my-method\"}`, a name of letters, digits, `-` and `_`;\n"
    "- a copy of `task.json`, whose hashes say which farms and clouds these were;\n"
    "- of each field `FIELD.csv` or `FIELD.geojson`, one row or feature a plot: its box, heights "
    "(`height_p99_m`, ...), intervals (`low95_height_p99_m`, `high95_height_p99_m`), any of them. "
    "Without a box a row names one of the given boxes by its `plot_number`.\n\n"
    "A field without a file counts as one of which nothing was found. docs/submissions.md of "
    "Plotscan has the whole format and examples.\n";

// TASK.md: the given files, the task and how to submit results.
std::string task_sheet(const json& task) {
  std::string text = "# Task: " + task.at("suite").get<std::string>() + "\n\n" +
                     std::to_string(task.at("fields").size()) +
                     " fields were scanned from a drone. Say where their plots are, how high the "
                     "crop of each stands, and how sure that is; or any part of it.\n\n";
  text += task.at("boxes_given").get<bool>() ? "The plots' boxes are given: heights are asked.\n\n"
                                             : "Nothing is known of the plots but the clouds.\n\n";
  std::vector<Cells> heights;
  for (const auto& [name, meaning] : task.at("heights").items())
    heights.push_back({"`" + name + "`", meaning});
  std::vector<Cells> fields;
  for (const json& field : task.at("fields")) {
    fields.push_back({"`" + field.at("field").get<std::string>() + "`",
                      std::to_string(field.at("points").get<std::uint64_t>())});
  }
  return text + "## What you have\n\nEach field is a folder:\n\n" + std::string(kFiles) + "\n" +
         std::string(kFrame) + "\n## What is asked\n\nHeights are scored against\n\n" +
         markdown_table({"height", "of the plot"}, heights) + "\n## How to hand it in\n\n" +
         std::string(kHandIn) + "\n## Fields\n\n" + markdown_table({"field", "points"}, fields);
}

// Makes the field's folder; what the task sheet says of it.
json export_field(const BlindField& field, const ExportOptions& options, const fs::path& folder,
                  const fs::path& work, const ProgressReport& progress) {
  fs::create_directories(work);
  fs::create_directories(folder);
  const FarmPlace place{field.suite_case, field.seed, work, options.threads};
  scan_farm(place, make_farm(place), [&](double share) {
    if (progress) progress(kExportFlown * share);
  });
  const std::uint64_t points = write_blind_files(place, options.parts, folder);
  json hashes = json::object();
  for (const auto& entry : fs::directory_iterator(folder))
    hashes[entry.path().filename().string()] = sha256_of_file(entry.path());
  json entry = {
      {"field", field.code},
      {"points", points},
      {"farm_sha256", blinded_farm_sha256(field.code, sha256_of_folder(work / "farm" / "truth"))},
      {"sha256", hashes}};
  fs::remove_all(work);
  return entry;
}

// The clock tells the order in which files were written.
void set_file_times(const fs::path& folder) {
  const auto instant = std::chrono::file_clock::from_sys(std::chrono::sys_seconds(
      std::chrono::sys_days{std::chrono::year{2000} / std::chrono::January / 1}));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    fs::last_write_time(entry.path(), instant);
  fs::last_write_time(folder, instant);
}

}  // namespace

ExportSummary export_suite(const ExportOptions& options, const ProgressReport& progress) {
  const Suite suite = chosen_suite(options.suite);
  require_parts(options.parts, suite);
  const std::vector<BlindField> fields = blind_fields(suite, options.suite);
  OutputFolder folder(options.output, options.replace, kExportCommand, {{options.suite.file}});
  const TemporaryPath work(folder.path().parent_path() /
                           (".farmbench-export-" + std::to_string(getpid())));
  ExportSummary summary{.fields = fields.size()};
  json task = {{"format", "plotscan task 1"}, {"plotscan", version()},
               {"suite", suite.name},         {"boxes_given", options.parts.boxes},
               {"heights", heights_asked()},  {"fields", json::array()}};
  for (const BlindField& field : fields) {
    const auto done = static_cast<double>(task["fields"].size());
    task["fields"].push_back(
        export_field(field, options, folder.path() / field.code, work.path(), [&](double share) {
          if (progress) progress((done + share) / static_cast<double>(fields.size()));
        }));
    summary.points += task["fields"].back()["points"].get<std::uint64_t>();
  }
  write_text_file(folder.path() / "task.json", json_lines(task));
  write_text_file(folder.path() / "TASK.md", task_sheet(task));
  write_manifest(folder.path(), {.command = kExportCommand,
                                 .options = {{"suite", suite.name},
                                             {"boxes", options.parts.boxes},
                                             {"seeds", suite.seeds.size()}}});
  set_file_times(folder.path());
  folder.commit();
  return summary;
}

}  // namespace plotscan::farmbench
