// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/utc_time.h"
#include "scan/cloud_reader.h"

namespace plotscan::scan {

// How many points have each number from 0 to 255, such as a class; larger numbers count as 255.
using CountByNumber = std::array<std::uint64_t, 256>;

// Everything that a cloud's files state about themselves.
struct CloudFacts {
  std::string format;                 // "LAS 1.2, point format 3"
  std::uint64_t points = 0;           // with finite coordinates
  std::uint64_t not_finite = 0;       // points with other coordinates
  std::uint64_t marked = 0;           // of `points`, withheld or of a noise class (LAS)
  Eigen::AlignedBox3d bounds = {};    // of the points, in the file's own coordinates
  Eigen::AlignedBox3d bounds_m = {};  // in metres (CloudSystem)
  CloudSystem system = {};
  std::vector<std::string> fields = {};       // names and order as in the file
  std::optional<CountByNumber> returns = {};  // by return number; nothing without that field
  std::optional<CountByNumber> classes = {};  // by ASPRS class (LAS, or a field of that name)
  // The earliest and the latest point's time: in seconds as the file counts them, and in UTC if the
  // file says from when they count (LAS with adjusted GPS time).
  std::optional<std::array<double, 2>> time_s = {};
  std::optional<std::array<UtcTime, 2>> utc = {};
};

// Widens a range so that it holds the value.
template <class Value>
void extend(std::optional<std::array<Value, 2>>& range, Value value) {
  if (!range) range = {value, value};
  range = {std::min((*range)[0], value), std::max((*range)[1], value)};
}

// Reads a cloud once, and passes its positions to the sink as read_positions does, but of all
// classes and of marked points, too. Format and fields are those of the first file. Throws
// InputError as read_positions does.
CloudFacts read_cloud_facts(const CloudFiles& cloud, const PositionSink& sink);

}  // namespace plotscan::scan
