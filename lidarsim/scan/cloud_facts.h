// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/utc_time.h"
#include "scan/cloud_reader.h"

namespace plotscan::scan {

// Points by a number of 0 to 255, such as their class; a number beyond counts as 255.
using CountByNumber = std::array<std::uint64_t, 256>;

// Everything that a cloud's file tells of itself.
struct CloudFacts {
  std::string format;                 // "LAS 1.2, point format 3"
  std::uint64_t points = 0;           // with finite coordinates
  std::uint64_t not_finite = 0;       // the others
  std::uint64_t marked = 0;           // of `points`, withheld or of a noise class (LAS)
  Eigen::AlignedBox3d bounds = {};    // of the points, in the file's own coordinates
  Eigen::AlignedBox3d bounds_m = {};  // in metres (CloudSystem)
  CloudSystem system = {};
  std::vector<std::string> fields = {};       // by the file's names, in its order
  std::optional<CountByNumber> returns = {};  // by number of the return; nothing without the field
  std::optional<CountByNumber> classes = {};  // by ASPRS class (LAS, fields of that name)
  // Of the first and the last point in time: seconds as the file counts them, and UTC where it says
  // from when (LAS with adjusted GPS time).
  std::optional<std::array<double, 2>> time_s = {};
  std::optional<std::array<UtcTime, 2>> utc = {};
};

// Reads a cloud once, and hands its positions to the sink as read_positions does, all classes and
// marked ones too. Format and fields are those of the first file.
// Throws InputError as read_positions does.
CloudFacts read_cloud_facts(const CloudFiles& cloud, const PositionSink& sink);

}  // namespace plotscan::scan
