// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

#include "report/shown_cloud.h"

namespace plotscan::report {

// Positions in pages are multiples of this, metres: an eighth of a VLP-16's range noise.
inline constexpr double kStep_m = 0.004;

// How many of a tile's n points its level k = 0..levels shows: every 2^(levels - k)th of them in
// Morton order, ceil(n / 2^(levels - k)). They stand in front, those of level k before what level
// k + 1 adds, so that any level is drawn as a beginning of the tile.
int tile_levels(std::size_t n);

// A cloud as pages hold it (docs/report-format.md): square tiles of at most 32,768 points, halved
// from the bounding square on, each one zlib stream. {read, shown, origin, time, has, tiles: [{n,
// at, bytes, low, step, high}], data}; `low` and `high` are the tile's bounds relative to origin;
// `at` and `bytes` are the stream's place in data, a multiple of 3 so that its base64 stands by
// itself. In a tile x, y, z as differences (packed.h), then, of what the cloud has, a byte a point:
// class; plot's low byte, its high byte (plots beyond 65535 are 65535); intensity; time as share of
// 255 of the cloud's.
nlohmann::json packed_cloud(const ShownCloud& cloud);

}  // namespace plotscan::report
