// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace plotscan::view {

// How far a plant reaches from its stem's foot in the plane of the picture, metres, none negative;
// and the width of its label, pixels.
struct PlantExtent {
  double left_m = 0;
  double right_m = 0;
  double above_m = 0;
  double below_m = 0;
  double label_px = 0;
};

// Plants that stand on one ground line.
struct PlantRow {
  std::size_t first = 0;  // index of its first plant
  std::size_t count = 0;
  double ground_px = 0;  // of the ground line over the picture's lower edge
  double label_px = 0;   // of the middle of its labels over the picture's lower edge
  double above_m = 0;    // of its highest plant
};

struct PlantLayout {
  double px_per_m = 0;                // one scale for all
  std::vector<PlantRow> rows;         // from the top
  std::vector<Eigen::Vector2d> feet;  // of each plant, pixels right and up from the lower left
};

// The pixels left of the plants, for the height scale.
inline constexpr double kScaleWidth_px = 64;

// Puts the plants in rows of `columns`, in their order, as large as fits the picture; columns 0
// takes the number that makes them largest. Throws InputError when they do not fit even when tiny.
PlantLayout lay_out(const std::vector<PlantExtent>& plants, const Eigen::Vector2d& picture_px,
                    std::size_t columns);

}  // namespace plotscan::view
