// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cloud/cloud_map.h"
#include "estimate/estimate.h"
#include "methods/dhami2020/dhami2020.h"
#include "score/score.h"
#include "terrain/terrain.h"

namespace plotscan::score {

// The height "p99" of every true plot over the true terrain: what dhami2020's "raw-p99" would say
// if its ground model were perfect. The points are the same, those of raw and voxel-filtered map in
// the true box lengthened by extend_m at both ends; a point's height is its z minus the terrain's
// under it, and those of more than plane_tolerance_m count. A plot without such a point, or outside
// the terrain, has no height. Uses only extend_m, plane_tolerance_m and voxel_m of `options`.
estimate::Estimate oracle_ground(const cloud::CloudMap& map, const std::vector<TruePlot>& plots,
                                 const terrain::Terrain& terrain,
                                 const methods::dhami2020::Options& options = {});

}  // namespace plotscan::score
