// SPDX-License-Identifier: Apache-2.0
#include "fieldpage/field_page.h"

#include "core/error.h"
#include "core/geodesy.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "estimate/ground_grids.h"
#include "farmfolder/terrain_ply.h"
#include "fieldpage/shown.h"

namespace plotscan::fieldpage {
namespace fs = std::filesystem;
namespace {

estimate::Estimate read(const fs::path& path, const std::optional<fs::path>& truth) {
  estimate::Estimate estimate =
      truth ? score::read_estimate_beside(*truth, path) : estimate::read_estimate(path);
  if (fs::exists(path / "ground.asc"))
    estimate.ground = estimate::read_ground(path, estimate.units.value_or(CoordinateUnits{}));
  return estimate;
}

// That the cloud's only file is not the one that was measured.
std::optional<std::string> other_cloud_note_of(const fs::path& estimate, const CloudFiles& cloud) {
  if (cloud.files.size() != 1) return std::nullopt;
  return other_cloud_note(estimate, cloud.files.front());
}

// The coordinate system that was given to estimator run, if any.
std::optional<std::string> given_crs(const fs::path& estimate) {
  const nlohmann::json::json_pointer crs("/options/crs");
  if (!fs::exists(estimate / "manifest.json")) return std::nullopt;
  const nlohmann::json manifest = read_manifest(estimate);
  if (!manifest.contains(crs) || !manifest[crs].is_string()) return std::nullopt;
  return manifest[crs].get<std::string>();
}

// Throws InputError where the cloud is said to be in other units than the estimate was made with.
void require_those_units(const fs::path& estimate, const CoordinateUnits& said,
                         const CoordinateUnits& used) {
  if (said.horizontal_m == used.horizontal_m) return;
  throw InputError(estimate, "was made with units of {}; its cloud cannot be shown in {}",
                   unit_name(used.horizontal_m), unit_name(said.horizontal_m));
}

void show_cloud(report::ShownField& field, const PageOptions& options,
                const std::optional<CoordinateUnits>& units, const ProgressReport& progress) {
  CloudFiles cloud = *options.cloud;
  cloud.files = cloud_files_of(cloud.files);
  const std::optional<std::string> note = other_cloud_note_of(options.estimate, cloud);
  if (cloud.units && units) require_those_units(options.estimate, *cloud.units, *units);
  if (!cloud.units) cloud.units = units;  // as they were given to estimator run
  if (!cloud.crs && !note) cloud.crs = given_crs(options.estimate);
  field.cloud = read_shown_positions(cloud, options.points, progress);
  report::note_cloud_elsewhere(field, cloud.name());
  field.facts.push_back({"points of the cloud", std::to_string(field.cloud->read)});
  if (note) field.notes.push_back(*note);
}

// A farm's truth, a map of true plots, or a table of measured heights.
void add_truth(report::ShownField& field, const estimate::Estimate& estimate, const fs::path& truth,
               const std::optional<std::string>& id) {
  if (score::is_measured_table(truth, id)) {
    const std::size_t shown = show_measured(field, score::read_measured(truth, estimate, id));
    field.facts.push_back({"plots measured by hand", std::to_string(shown)});
    return;
  }
  const std::vector<score::TruePlot> plots = score::read_truth(truth, estimate.crs);
  show_truth(field, estimate, plots);
  if (const std::string note = score::apart_note(plots, estimate); !note.empty())
    field.notes.push_back(note);
  const fs::path terrain = truth / "truth" / "terrain.ply";
  if (fs::exists(terrain)) {
    if (utm_system(estimate.crs))
      field.notes.emplace_back("The true ground is not shown: it is in the farm's own metres.");
    else
      show_terrain(field, farmfolder::read_terrain(terrain));
  }
  field.facts.push_back({"true plots", std::to_string(field.true_boxes.size())});
}

}  // namespace

report::PageSummary write_estimate_page(const PageOptions& options,
                                        const ProgressReport& progress) {
  std::vector<fs::path> inputs = {options.estimate};
  if (options.truth) inputs.push_back(*options.truth);
  if (options.cloud)
    inputs.insert(inputs.end(), options.cloud->files.begin(), options.cloud->files.end());
  report::require_page(options.html, inputs);
  OutputFile file(options.html, options.replace);
  const estimate::Estimate estimate = read(options.estimate, options.truth);
  report::ShownField field{.name = report::shown_name(options.estimate)};
  if (!estimate.method.empty()) field.facts.push_back({"method", estimate.method});
  field.facts.push_back({"plots", std::to_string(estimate.plots.size())});
  if (!estimate.diagnostics.why_no_plots.empty())
    field.notes.push_back(estimate.diagnostics.why_no_plots);
  show_estimate(field, estimate);
  show_working(field, estimate);
  if (options.truth) add_truth(field, estimate, *options.truth, options.id);
  if (options.cloud) show_cloud(field, options, estimate.units, progress);
  auto summary = report::write_field_page(file.path(), "estimate", "Plots of " + field.name, field);
  file.commit();
  return summary;
}

}  // namespace plotscan::fieldpage
