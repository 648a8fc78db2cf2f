// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: which of a field's points may be canopy.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/ground_error.h"

namespace plotscan::plots {

// Heights above the ground that count as no canopy and as full canopy; in between the share is
// linear.
struct CanopyScale {
  double low_m = 0;
  double high_m = 0;
};

// A field's points as (x, y, height above the ground), metres. Left out are points that are not
// finite, blocks of a survey's margin with less than a tenth of the field's density, blocks filled
// by a smooth surface (canopy scatters heights by more than the sensor's noise; else it is a wall,
// a car's roof, a sheet, or ground that the ground's model missed), and places whose ground is too
// uncertain to distinguish ridges from canopy.
class FieldCanopy {
 public:
  // noise_m is the sigma of the points' heights.
  FieldCanopy(std::span<const Eigen::Vector3f> points, double noise_m, int threads,
              const GroundError& ground_error = {});

  // The points that are not left out, in their order.
  std::span<const Eigen::Vector3f> points() const { return kept_; }
  bool leaves_out(const Eigen::Vector3f& point) const;
  // From the noise to the usual height of the canopy's top, over the blocks that have canopy.
  const CanopyScale& scale() const { return scale_; }
  // Share of smooth surfaces among the blocks that stand out from the ground within reach_m of the
  // places.
  double surface_share(std::span<const Eigen::Vector2d> places, double reach_m) const;

 private:
  struct Block;

  std::size_t lay_out_blocks(std::span<const Eigen::Vector3f> points);
  std::vector<Block> filled_blocks(std::span<const Eigen::Vector3f> points, std::size_t count,
                                   double canopy_m) const;
  std::size_t block_of(const Eigen::Vector3f& point) const;
  std::size_t cell_of(const Eigen::Vector3f& point) const;
  void leave_out_surfaces();
  void leave_out_unsure_ground(const GroundError& ground_error);

  std::vector<Eigen::Vector3f> kept_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double block_m_ = 1;
  std::size_t blocks_along_y_ = 0;
  std::vector<std::uint8_t> left_out_, surface_, stands_out_;  // by block
  std::vector<std::uint8_t> unsure_;                           // by cell of a block
  CanopyScale scale_;
};

}  // namespace plotscan::plots
