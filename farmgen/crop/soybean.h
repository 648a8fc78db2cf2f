// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::crop {

// The parameters of a soybean in mid-season (about R2: full height, canopy nearly closed). Lengths
// are those of the largest internode, petiole or leaflet; the others follow profiles along the
// stem.
struct SoybeanOptions {
  double nodes = 13;                  // nodes of the main stem; a leaf at each from first_leaf_node
  double first_leaf_node = 3;         // the lower leaves are shed
  double internode_m = 0.065;         // distance between nodes
  double lean_deg = 3;                // largest lean of the stem's foot
  double zigzag_deg = 6;              // turn of the stem at each node
  double stem_radius_m = 0.004;       // at the foot; tapers to a quarter
  double branches = 3;                // from the lowest nodes
  double branch_nodes = 4;            // leaves of a branch
  double branch_angle_deg = 40;       // of a branch from the vertical
  double phyllotaxis_deg = 137.5;     // azimuth from one leaf to the next
  double petiole_m = 0.15;            // length
  double petiole_angle_deg = 55;      // from the vertical
  double leaflet_length_m = 0.1;      // of the three leaflets of a leaf
  double leaflet_width_ratio = 0.62;  // width over length
  double leaflet_bend_deg = 45;       // how far the tip droops from the base's direction
  double leaflet_fold_deg = 12;       // of each half, upward about the midrib
  double variation = 0.15;            // each length and angle varies uniformly by this share
};

// The options with "key=value" assignments applied. Throws InputError on an unknown key, or a value
// that is not a number in the key's range.
SoybeanOptions soybean_options(const std::vector<std::string>& assignments);

// One line a key: name, default, range. For --help.
std::string soybean_options_help();

// A soybean of open leaf sheets and tubes, its stem's foot at the origin. Coordinates are whole
// hundredths of a millimetre, so that the mesh is the same with every mathematical library.
mesh::Mesh soybean(const SoybeanOptions& options, std::uint64_t seed);

}  // namespace plotscan::crop
