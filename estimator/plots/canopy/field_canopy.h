// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which of a field's points may be canopy.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/canopy/field_blocks.h"
#include "plots/ground_error.h"

namespace plotscan::plots {

// Heights above the ground that count as no canopy and as full canopy; in between the share is
// linear.
struct CanopyScale {
  double low_m = 0;
  double high_m = 0;
  bool with_others = false;  // what is set aside counts too
};

// What may be the crop that the plots are sown with.
struct Crop {
  double top_m = 0;               // its height; 0 where nothing stands out
  std::vector<bool> others = {};  // of each block, whether it may hold another; none where empty
};

// A field's points as (x, y, height above the ground), metres, for one crop. Left out are points
// that are not finite, blocks of a survey's margin with less than a tenth of the field's density,
// blocks filled by a smooth surface (canopy scatters heights by more than the sensor's noise; else
// it is a wall, a car's roof, a sheet, or ground that the ground's model missed), and places whose
// ground is too uncertain to distinguish ridges from canopy. Set aside are blocks of other crops
// and those that are twice as tall, as hedges, trees and cars beside a field are.
class FieldCanopy {
 public:
  // `blocks` are those of `points` and outlive this.
  FieldCanopy(std::span<const Eigen::Vector3f> points, const FieldBlocks& blocks, const Crop& crop,
              int threads, const GroundError& ground_error = {});

  // The points that are not left out: those that may be the crop first, in their order, then those
  // that are set aside.
  std::span<const Eigen::Vector3f> points() const { return kept_; }
  std::size_t crop_points() const { return crop_points_; }
  bool leaves_out(const Eigen::Vector3f& point) const;
  // From the noise to the crop's top.
  const CanopyScale& scale() const { return scale_; }
  // Share of smooth surfaces among the blocks that stand out from the ground within reach_m of the
  // places.
  double surface_share(std::span<const Eigen::Vector2d> places, double reach_m) const;

 private:
  void leave_out_surfaces();
  void set_tall_blocks_aside();
  void leave_out_unsure_ground(const GroundError& ground_error);

  const FieldBlocks& blocks_;
  CanopyScale scale_;
  std::vector<std::uint8_t> left_out_, aside_;  // by block
  std::vector<std::uint8_t> unsure_;            // by cell of a block
  std::vector<Eigen::Vector3f> kept_;
  std::size_t crop_points_ = 0;
};

}  // namespace plotscan::plots
