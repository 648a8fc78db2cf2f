// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cloud/area.h"
#include "cloud/tile_store.h"
#include "core/cloud_files.h"
#include "core/progress.h"

namespace plotscan::cloud {

struct FieldOptions {
  std::optional<Area> area = std::nullopt;  // else the densely scanned field is found (FieldHull)
  std::string area_name = "crop box";       // what messages call it
  // Most points kept in a cell of 0.125 m. 256, or 16,384 a square metre, takes 0.1 % of a flight
  // of 3,400 points a square metre (128 would take 6 %), and bounds a hectare to 164 million
  // points.
  std::size_t points_per_cell = 256;
  int threads = 1;
};

// How many of a cloud's points were kept, or dropped and why: `read` is the sum of all others.
struct FieldCounts {
  std::uint64_t read = 0;
  std::uint64_t not_finite = 0;
  std::uint64_t marked = 0;    // withheld, or of a noise class, in a LAS file
  std::uint64_t left_out = 0;  // of a class to leave out (CloudFiles)
  std::uint64_t outside = 0;   // of the field, or beyond any coordinate that makes sense
  std::uint64_t repeated = 0;  // the same point to 0.06 mm was there already
  std::uint64_t thinned = 0;   // points_per_cell others were there
  std::uint64_t outliers = 0;  // neither ground nor crop (outliers.h)
  std::uint64_t kept = 0;
};

// A field's points, ready to measure; the field's area bounds their number. Points are rounded to
// 2^-14 m = 0.06 mm and sorted by tile of 1 m (south to north, in a row west to east), within a
// tile by cell of 0.125 m (likewise), within a cell in a practically random order: neighbours in
// the plane are neighbours in memory, and the first points of a cell are a fair sample of it. The
// same points in any order, or moved by whole metres, give the same positions.
struct FieldCloud {
  Area area{};                                       // bounds of the field, world frame, metres
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // whole metres
  std::vector<Eigen::Vector3f> points = {};          // relative to origin
  FieldCounts counts = {};
  double density_m2 = 0;  // points in the median square metre (field_density)
  // The points that the user allows as ground, relative to origin; empty if he names none.
  std::vector<Eigen::Vector3f> ground_points = {};
};

// Streams a cloud once, in memory bounded by the area over which it lies (tile_store.h). Throws
// InputError on a broken cloud, or when no point lies in the area.
FieldCloud read_field(const CloudFiles& cloud, const FieldOptions& options,
                      const ProgressReport& progress = {});

// The field of the points in a store, which cannot be used afterwards. `name` is the cloud's name
// in messages.
FieldCloud take_field(TileStore& store, const FieldOptions& options, const std::string& name);

}  // namespace plotscan::cloud
