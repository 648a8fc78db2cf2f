// SPDX-License-Identifier: Apache-2.0
#include "farmbench/export/dataset.h"

#include <algorithm>
#include <array>
#include <functional>

#include <fmt/core.h>
#include <unistd.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/list_of.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "core/text_file.h"
#include "farmbench/export/internal/labelled_scans.h"
#include "farmbench/farm_scan.h"
#include "farmbench/markdown.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* kDatasetCommand = "farmbench export --dataset";
constexpr std::array<const char*, 5> kClasses = {"unlabelled", "ground", "crop", "weed", "other"};
constexpr std::array<const char*, 3> kSplits = {"train", "validation", "test"};

json plot_json(const score::TruePlot& plot) {
  return {{"plot", plot.id},
          {"center_m", {plot.box.center.x(), plot.box.center.y()}},
          {"width_m", plot.box.width_m},
          {"length_m", plot.box.length_m},
          {"heading_deg", plot.box.heading_rad / kDegrees},
          {"heights_m", plot.heights_m}};
}

json counts_json(const ScanCounts& counts) {
  json by_class = json::object();
  for (std::size_t i = 0; i < kClasses.size(); ++i) by_class[kClasses[i]] = counts.by_class[i];
  return {{"scans", counts.scans}, {"points", counts.points}, {"points_by_class", by_class}};
}

struct Sequence {
  const SuiteCase& suite_case;
  std::uint64_t seed;
  std::string name;
  std::string split;
};

// Which part of the data set the farms of the suite's index-th seed are: of five seeds the fourth
// is "validation", the fifth "test", the others are "train".
std::string split_of(std::size_t seed_index) {
  const std::size_t place = seed_index % 5;
  return place == 3 ? "validation" : place == 4 ? "test" : "train";
}

std::vector<Sequence> sequences_of(const Suite& suite) {
  std::vector<Sequence> sequences;
  for (const SuiteCase& suite_case : suite.cases) {
    if (suite_case.survey)
      throw InputError(suite.file, "case {} surveys a part of a field; data sets have whole ones",
                       suite_case.name);
    for (std::size_t i = 0; i < suite.seeds.size(); ++i)
      sequences.push_back(
          {suite_case, suite.seeds[i], fmt::format("{:02}", sequences.size()), split_of(i)});
  }
  return sequences;
}

// Makes the sequence's folder; what the index says of it.
json write_sequence(const Sequence& sequence, const fs::path& folder, const fs::path& work,
                    int threads, const ProgressReport& progress) {
  fs::create_directories(work);
  fs::create_directories(folder);
  const FarmPlace place{sequence.suite_case, sequence.seed, work, threads};
  scan_farm(place, make_farm(place), progress);
  json document = counts_json(write_labelled_scans(work / "scan", folder));
  std::vector<score::TruePlot> plots = standing_plots(place);
  if (sequence.suite_case.without_plots) plots.clear();
  document["sequence"] = sequence.name;
  document["split"] = sequence.split;
  document["case"] = sequence.suite_case.name;
  document["seed"] = sequence.seed;
  document["plots"] = list_of(plots, plot_json);
  fs::remove_all(work);
  return document;
}

std::string counts_table(const json& sequences) {
  Cells heads = {"split", "farms", "scans", "points", "plots"};
  heads.insert(heads.end(), kClasses.begin(), kClasses.end());
  std::vector<Cells> rows;
  for (const char* split : kSplits) {
    std::vector<std::uint64_t> sums(heads.size() - 1);
    for (const json& sequence : sequences) {
      if (sequence["split"] != split) continue;
      std::vector<std::uint64_t> counts = {1, sequence["scans"], sequence["points"],
                                           sequence["plots"].size()};
      for (const char* name : kClasses) counts.push_back(sequence["points_by_class"][name]);
      std::ranges::transform(sums, counts, sums.begin(), std::plus<>());
    }
    Cells& cells = rows.emplace_back(Cells{split});
    for (const std::uint64_t sum : sums) cells.push_back(std::to_string(sum));
  }
  return markdown_table(heads, rows);
}

std::string card(const json& document, const std::string& command) {
  return "# Data set " + document["suite"].get<std::string>() +
         "\n\nSimulated LiDAR scans of virtual crop trials from a drone, made by Plotscan " +
         version() +
         ". Every point has its class, plot and plant; every plot its box and heights. The truth "
         "is that of the simulator: exact.\n\n## Counts\n\n" +
         counts_table(document["sequences"]) +
         "\nFarms are in one split as wholes, by their seed: of five seeds of each case the fourth "
         "is validation, the fifth test.\n\n## Layout\n\nAs SemanticKITTI's: "
         "`sequences/NN/velodyne/NNNNNN.bin` (float32 x, y, z, intensity 0 to 1, in the lidar's "
         "frame), `labels/NNNNNN.label` (uint32: class in the lower 16 bits, plot in the upper "
         "ones, 0 none), `plants/NNNNNN.plant` (uint32: plant, 0 none), `poses.txt` (world from "
         "lidar, a row of 3 x 4 numbers a scan), `calib.txt` (KITTI's; Tr is the identity, and "
         "there "
         "are no cameras), `times.txt` (seconds). A scan is one turn of the "
         "sensor. `dataset.json` has the classes, the sequences, their splits and counts, and the "
         "plots' boxes and heights in the world's frame. Plotscan's docs/dataset.md says more."
         "\n\n## Made again, bit by bit\n\nWith Plotscan " +
         version() + ":\n\n```\n" + command +
         "\n```\n\n## Licence\n\nApache-2.0, as the farms and plants of Plotscan that it is made "
         "of. A suite with meshes of others has their licences too.\n";
}

}  // namespace

DatasetSummary export_dataset(const ExportOptions& options, const std::string& command,
                              const ProgressReport& progress) {
  const Suite suite = chosen_suite(options.suite);
  const std::vector<Sequence> sequences = sequences_of(suite);
  OutputFolder folder(options.output, options.replace, kDatasetCommand, {{suite.file}});
  const TemporaryPath work(folder.path().parent_path() /
                           (".farmbench-dataset-" + std::to_string(getpid())));
  json document = {{"format", "plotscan dataset 1"},
                   {"plotscan", version()},
                   {"suite", suite.name},
                   {"classes", kClasses},
                   {"sequences", json::array()}};
  DatasetSummary summary{.farms = sequences.size()};
  for (const Sequence& sequence : sequences) {
    const auto done = static_cast<double>(document["sequences"].size());
    document["sequences"].push_back(
        write_sequence(sequence, folder.path() / "sequences" / sequence.name, work.path(),
                       options.threads, [&](double share) {
                         if (progress)
                           progress((done + share) / static_cast<double>(sequences.size()));
                       }));
    summary.scans += document["sequences"].back()["scans"].get<std::size_t>();
    summary.points += document["sequences"].back()["points"].get<std::uint64_t>();
  }
  write_text_file(folder.path() / "dataset.json", json_lines(document));
  write_text_file(folder.path() / "README.md", card(document, command));
  write_manifest(folder.path(), {.command = kDatasetCommand,
                                 .options = {{"suite", suite.name}, {"seeds", suite.seeds}},
                                 .inputs = {suite.file}});
  folder.commit();
  return summary;
}

}  // namespace plotscan::farmbench
