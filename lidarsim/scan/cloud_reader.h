// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/cloud_files.h"
#include "scan/cloud_system.h"

namespace plotscan::scan {

// Receives a cloud's positions piece by piece, in the file's order, in metres as
// CloudSystem::metres_of gives them.
using PositionSink = std::function<void(std::span<const Eigen::Vector3d>)>;

// What was read.
struct CloudSummary {
  std::size_t points = 0;      // passed to the sink
  std::size_t not_finite = 0;  // left out: not finite, or degrees too far from the zone
  std::size_t marked = 0;      // left out: marked as not to be processed (PositionOptions)
  std::size_t left_out = 0;    // left out: of a class that CloudFiles excludes
  CloudSystem system = {};     // the coordinate system of the files
};

struct PositionOptions {
  // Leaves out what a LAS file marks as not to be processed: points that are withheld, and those of
  // the classes 7 (low noise) and 18 (high noise). LAS Specification 1.4 - R15, tables 8 and 16
  // (withheld, by point format) and 17 (classes).
  bool leave_out_marked = false;
};

// Streams the x, y, z of a PCD (ascii, binary, binary_compressed), PLY (ascii, binary), LAS (1.0 to
// 1.4) or text cloud (a line a point), file after file, whatever other fields they have. Only
// positions are passed on, so that an estimator cannot see labels. Memory is constant, except for
// compressed PCD. Throws InputError (file, what is wrong) on a missing, foreign, truncated or empty
// cloud, as read_cloud_system does, and on a file without classes where only some are to be read.
CloudSummary read_positions(const CloudFiles& cloud, const PositionSink& sink,
                            const PositionOptions& options = {});

// All positions of a cloud that is near its origin, in the file's order. Throws as the above does.
std::vector<Eigen::Vector3f> read_positions(const std::filesystem::path& cloud);

// About how many points a cloud's files hold: from their headers, or for text from its length.
// Throws InputError as read_positions does, for what it reads of the files.
double expected_points(const CloudFiles& cloud);

}  // namespace plotscan::scan
