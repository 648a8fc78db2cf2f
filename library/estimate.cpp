// SPDX-License-Identifier: Apache-2.0
#include "plotscan/estimate.h"

#include <cmath>

#include <fmt/core.h>

#include "boundary/field_estimate.h"
#include "boundary/guarded.h"
#include "boundary/settings.h"
#include "boundary/values.h"
#include "cloud/field_cloud.h"
#include "cloud/tile_store.h"
#include "core/coordinate_units.h"
#include "core/error.h"
#include "core/text.h"
#include "methods/run.h"

namespace plotscan {
namespace {

// Those of files are checked where they are read.
std::vector<PlotBox> inner(const std::vector<Box>& boxes) {
  std::vector<PlotBox> made;
  for (const Box& box : boxes) {
    made.push_back(boundary::inner(box));
    const PlotBox& last = made.back();
    const bool placed = last.center.allFinite() && std::isfinite(last.heading_rad);
    if (placed && last.width_m > 0 && last.length_m > 0 && std::isfinite(last.area_m2())) continue;
    throw InputError(
        fmt::format("box {} of {}: its centre and heading must be finite, its width and length "
                    "above 0",
                    made.size(), boxes.size()));
  }
  return made;
}

// Throws InputError on a setting that tells where plots are, where none is searched for.
template <class Options>
void require_no_search(const std::map<std::string, SettingValue>& given,
                       const std::vector<MethodSetting<Options>>& table) {
  for (const MethodSetting<Options>& setting : table) {
    if (setting.searches && given.contains(setting.key))
      throw InputError(fmt::format(
          "{} is of the search for plots; boxes are given, and none is searched for", setting.key));
  }
}

methods::lattice::Options inner(const EstimateOptions& options) {
  methods::lattice::Options made{.crop_box = options.crop_box};
  made.boxes = inner(options.boxes);
  if (!made.boxes.empty()) require_no_search(options.settings, methods::lattice::settings());
  boundary::take("lattice", options.settings, methods::lattice::settings(), made);
  if (!made.ground_classes.empty())
    throw InputError("ground_classes is for files: points in memory have no classes");
  made.threads = boundary::threads_of(options.threads);
  return made;
}

// Hands the finite points on, piece by piece; returns how many were not.
std::size_t feed(const PointsView& points, cloud::TileStore& store) {
  constexpr std::size_t kPiece = 1 << 16;
  std::vector<Eigen::Vector3d> piece;
  piece.reserve(kPiece);
  std::size_t not_finite = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    piece.emplace_back(points[i].data());
    if (!piece.back().allFinite()) {
      piece.pop_back();
      ++not_finite;
    }
    if (piece.size() < kPiece && i + 1 < points.size()) continue;
    store.add(piece);
    piece.clear();
  }
  return not_finite;
}

cloud::FieldCloud field_of(const PointsView& points, const methods::lattice::Options& options,
                           const Progress& progress) {
  const cloud::FieldOptions reading = field_options(options);
  cloud::TileStore store({.points_per_cell = reading.points_per_cell, .threads = reading.threads});
  const std::size_t not_finite = feed(points, store);
  if (not_finite == points.size()) throw InputError("the cloud has no point that is finite");
  if (progress) progress(0.1);
  cloud::FieldCloud field = take_field(store, reading, "the cloud");
  field.counts.read += not_finite;
  field.counts.not_finite = not_finite;
  if (progress) progress(0.2);
  return field;
}

void require_classes(const std::vector<int>& classes) {
  for (const int number : classes)
    if (number < 0 || number > 255)
      throw InputError(fmt::format("leave_out_classes has {}; ASPRS classes are 0 to 255", number));
}

CloudFiles files_of(const EstimateFilesOptions& options) {
  require_classes(options.leave_out_classes);
  CloudFiles cloud;
  if (const auto unit_m = unit_named(options.units.value_or(""))) cloud.units = {*unit_m, *unit_m};
  if (options.units && !cloud.units)
    throw InputError(
        fmt::format("units are {}; not \"{}\"", joined(unit_symbols(), ", "), *options.units));
  cloud.crs = options.crs;
  cloud.recording = {
      .trajectory = options.trajectory, .sensor = options.sensor, .topic = options.topic};
  if (options.mount_rpy_deg)
    cloud.recording.mount_rpy_deg = Eigen::Vector3d(options.mount_rpy_deg->data());
  cloud.leave_out_classes = options.leave_out_classes;
  return cloud;
}

// Throws InputError where plots are to be numbered that have their own names.
estimate::NumberingOptions numbering_of(const EstimateFilesOptions& options) {
  estimate::NumberingOptions numbering{.first_number = options.first_number,
                                       .names = options.plot_names};
  if (options.numbering) numbering.numbering = estimate::numbering_named(*options.numbering);
  if (options.first_corner) numbering.first_corner = estimate::corner_named(*options.first_corner);
  if (options.boxes && numbering.any())
    throw InputError(
        "first_number, numbering, first_corner and plot_names are of plots that are found; boxes "
        "have names of their own");
  if (numbering.names && (numbering.first_number || numbering.numbering))
    throw InputError("first_number and numbering are of plots that plot_names does not name");
  return numbering;
}

methods::RunOptions inner(const EstimateFilesOptions& options) {
  if (!options.field.boxes.empty())
    throw InputError("boxes of clouds in files are a map's: give its file");
  methods::RunOptions run;
  run.method = options.method;
  run.cloud = files_of(options);
  run.boxes = options.boxes;
  run.numbering = numbering_of(options);
  run.id = options.id;
  run.measured = options.measured;
  run.csv = options.csv;
  run.replace = options.replace;
  run.crop_box = options.field.crop_box;
  methods::for_each_method(run, [&](const std::string& name, const auto& settings, auto& own) {
    if (name != run.method) return;
    if (run.boxes) require_no_search(options.field.settings, settings);
    boundary::take(name, options.field.settings, settings, own);
  });
  run.seed = options.seed;
  run.threads = boundary::threads_of(options.field.threads);
  return run;
}

}  // namespace

std::vector<Setting> estimate_settings(const std::string& method) {
  return boundary::guarded([&] {
    methods::require_known(method);
    std::vector<Setting> found;
    const methods::RunOptions usual;
    methods::for_each_method(usual,
                             [&](const std::string& name, const auto& settings, const auto& own) {
                               if (name == method) found = boundary::outer(settings, own);
                             });
    return found;
  });
}

FieldEstimate estimate_field(const PointsView& points, const EstimateOptions& options,
                             const Progress& progress) {
  return boundary::guarded([&] {
    const methods::lattice::Options method = inner(options);
    require_sound(method);
    return boundary::outer(
        methods::lattice::estimate_plots(field_of(points, method, progress), method, progress));
  });
}

FieldEstimate estimate_files(const std::vector<std::filesystem::path>& clouds,
                             const std::filesystem::path& folder,
                             const EstimateFilesOptions& options, const Progress& progress) {
  return boundary::guarded([&] {
    methods::RunOptions run = inner(options);
    run.cloud.files = clouds;
    run.output = folder;
    return boundary::outer(methods::run(run, progress));
  });
}

}  // namespace plotscan
