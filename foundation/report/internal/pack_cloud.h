// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

#include "report/shown_cloud.h"

namespace plotscan::report {

// Positions in pages are multiples of this, metres: an eighth of a VLP-16's range noise.
inline constexpr double kStep_m = 0.004;

// The number of levels above level 0 of a tile of n points. Level k = 0..levels shows every
// 2^(levels - k)th point in Morton order, ceil(n / 2^(levels - k)) in all. The points of level k
// are stored before those that level k + 1 adds, so that each level is drawn as the first part of
// the tile.
int tile_levels(std::size_t n);

// A cloud as pages hold it (docs/report-format.md): square tiles of at most 32,768 points, halved
// from the bounding square on, each packed as one zlib stream: {read, shown, origin, time, has,
// tiles: [{n, at, bytes, low, step, high}], data}; `low` and `high` are the tile's bounds relative
// to origin; `at` and `bytes` are the stream's place in data, a multiple of 3 so that its base64
// stands by itself. A tile holds x, y, z as differences (packed.h), then, for each field that the
// cloud has, one byte a point: class; the plot's low byte, its high byte (plots beyond 65535 become
// 65535); intensity; time, 0 to 255 from the first to the last `time`.
nlohmann::json packed_cloud(const ShownCloud& cloud);

}  // namespace plotscan::report
