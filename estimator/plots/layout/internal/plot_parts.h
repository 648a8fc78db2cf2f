// SPDX-License-Identifier: Apache-2.0
#pragma once

// Bands that are parts of wider plots.

#include <optional>
#include <span>
#include <vector>

#include "plots/canopy/canopy_profile.h"

namespace plotscan::plots {

// Plots that were seen as several bands each; lengths in cells.
struct JoinedParts {
  int size = 0;
  std::vector<std::vector<int>> begins = {};  // line by line
};

// Gaps of one width close alike. Where some are full of canopy and others as wide are open, the
// bands between two open ones are parts of one plot: two pairs of drill rows, say, with a row
// between them. `begins` are those of bands of one size on each profile, in their order. Nothing
// where gaps do not differ so, or where plots would not have equally many parts.
std::optional<JoinedParts> joined_parts(std::span<const ProfileSums> profiles,
                                        const std::vector<std::vector<int>>& begins, int size);

}  // namespace plotscan::plots
