// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/range.h"
#include "estimate/estimate.h"

namespace plotscan::view {

struct FieldPictureOptions {
  static constexpr Range kSize_px{400, 8192}, kMargin_m{0, 1e4};

  int width_px = 1600;  // the picture is as large as fits in
  int height_px = 1400;
  double margin_m = 3;  // shown around the plots
};

// Draws an estimate's field as seen from straight above, north up, and writes a PNG: the cloud
// (PCD, PLY, LAS) coloured by height above the estimate's ground, each plot's box with its number,
// boxes of flagged plots in another colour. Numbers that would not fit their boxes are thinned out.
// For an estimate without plots the ground's whole extent is shown. Needs a display as draw_picture
// does. Throws InputError on options out of range, an estimate without ground, a cloud that is
// broken or has no point there, or a missing display; WriteError when the file cannot be written.
void draw_field(const std::filesystem::path& cloud, const estimate::Estimate& estimate,
                const std::filesystem::path& png, const FieldPictureOptions& options);

}  // namespace plotscan::view
