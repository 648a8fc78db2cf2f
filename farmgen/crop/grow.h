// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::crop {

enum class Detail {
  scan,   // what a laser should see: every leaf's shape
  light,  // the same plant in few triangles, for programs that show thousands
};

struct GrowOptions {
  std::string crop;                      // one of crops()
  std::string stage;                     // one of stages(crop); empty: the crop's default stage
  std::vector<std::string> assignments;  // "key=value" in place of the crop's parameters
  Detail detail = Detail::scan;
};

// "soybean", ...
std::vector<std::string> crops();
// The growth stages of a crop, in the order in which it passes through them.
std::vector<std::string> stages(const std::string& crop);

// Grows one plant, its stem's foot at the origin, metres, z up. The same options and seed give the
// same mesh; both details show the same plant. Throws InputError on an unknown crop, stage or key,
// or a value out of its range.
mesh::Mesh grow(const GrowOptions& options, std::uint64_t seed);

}  // namespace plotscan::crop
