// SPDX-License-Identifier: Apache-2.0
#include "plotscan/estimate.h"

#include "boundary/field_estimate.h"
#include "boundary/guarded.h"
#include "boundary/values.h"
#include "cloud/field_cloud.h"
#include "cloud/tile_store.h"
#include "methods/lattice/lattice.h"
#include "methods/run.h"

#include "core/coordinate_units.h"
#include "core/error.h"

namespace plotscan {
namespace {

methods::lattice::Options inner(const EstimateOptions& options) {
  methods::lattice::Options made{.crop_box = options.crop_box};
  made.heading_deg = options.heading_deg;
  made.plot_width_m = options.plot_width_m;
  made.plot_length_m = options.plot_length_m;
  made.rows = options.rows;
  made.columns = options.columns;
  made.plots = options.plots;
  for (const Box& box : options.boxes) made.boxes.push_back(boundary::inner(box));
  made.noise_m = options.noise_m;
  made.calibrated = options.calibrated;
  made.crop = options.crop;
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
  run.lattice = inner(options.field);
  run.dhami2020.plots = options.field.plots.value_or(0);
  run.seed = options.seed;
  run.threads = run.lattice.threads;
  return run;
}

}  // namespace

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
