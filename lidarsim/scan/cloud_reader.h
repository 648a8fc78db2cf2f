// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace plotscan::scan {

// Receives a cloud's positions piece by piece, in the file's order, world frame, metres.
using PositionSink = std::function<void(std::span<const Eigen::Vector3d>)>;

// What was read.
struct CloudSummary {
  std::size_t points = 0;      // handed to the sink
  std::size_t not_finite = 0;  // left out: a coordinate was NaN or infinite
  std::size_t marked = 0;      // left out: marked as no part of the scene (PositionOptions)
  // The coordinate system where the file names it (LAS): "EPSG:<code>", or well-known text where
  // that names no code; else "".
  std::string crs = {};
  bool in_degrees = false;  // x and y are longitude and latitude: the file says so
  // What the user should be told of how the file was read, a sentence each.
  std::vector<std::string> notes = {};
};

struct PositionOptions {
  // Leaves out what a LAS file marks as not to be processed: points that are withheld, and those of
  // the classes 7 (low noise) and 18 (high noise). LAS Specification 1.4 - R15, tables 8, 16, 17
  // (cited from memory).
  bool leave_out_marked = false;
};

// Streams the x, y, z of a PCD (ascii, binary, binary_compressed), PLY (ascii, binary), LAS (1.0 to
// 1.4) or text cloud (a line a point), whatever other fields it has. Nothing but positions is
// handed on, so that an estimator cannot see labels. All but compressed PCD is read in constant
// memory. Throws InputError (file, what is wrong) on a missing, foreign, truncated or empty cloud.
CloudSummary read_positions(const std::filesystem::path& cloud, const PositionSink& sink,
                            const PositionOptions& options = {});

}  // namespace plotscan::scan
