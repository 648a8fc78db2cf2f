// SPDX-License-Identifier: Apache-2.0
#include "plotscan/estimate.h"

#include "boundary/field_estimate.h"
#include "boundary/guarded.h"
#include "boundary/settings.h"
#include "boundary/values.h"
#include "cloud/field_cloud.h"
#include "cloud/tile_store.h"
#include "methods/run.h"

#include "core/coordinate_units.h"
#include "core/error.h"

namespace plotscan {
namespace {

methods::lattice::Options inner(const EstimateOptions& options) {
  methods::lattice::Options made{.crop_box = options.crop_box};
  for (const Box& box : options.boxes) made.boxes.push_back(boundary::inner(box));
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
  const cloud::FieldOptions field_options{.area = area_to_read(options),
                                          .threads = options.threads};
  cloud::TileStore store(
      {.points_per_cell = field_options.points_per_cell, .threads = options.threads});
  const std::size_t not_finite = feed(points, store);
  if (not_finite == points.size()) throw InputError("the cloud has no point that is finite");
  if (progress) progress(0.1);
  cloud::FieldCloud field = take_field(store, field_options, "the cloud");
  field.counts.read += not_finite;
  field.counts.not_finite = not_finite;
  if (progress) progress(0.2);
  return field;
}

methods::RunOptions inner(const EstimateFilesOptions& options) {
  methods::RunOptions run;
  run.method = options.method;
  run.boxes = options.boxes;
  if (const auto unit_m = unit_named(options.units.value_or("")))
    run.cloud.units = {*unit_m, *unit_m};
  if (options.units && !run.cloud.units)
    throw InputError("units are m, ft or us-ft, not \"" + *options.units + "\"");
  run.cloud.leave_out_classes = options.leave_out_classes;
  run.id = options.id;
  run.csv = options.csv;
  run.replace = options.replace;
  run.crop_box = options.field.crop_box;
  methods::for_each_method(run, [&](const std::string& name, const auto& settings, auto& own) {
    if (name == run.method) boundary::take(name, options.field.settings, settings, own);
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
