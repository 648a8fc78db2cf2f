// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <vtkImageShrink3D.h>
#include <vtkNew.h>

#include "core/range.h"

class vtkRenderWindow;

namespace plotscan::view {

// Pixels drawn each way for one of a drawing, so that awns and thin stems show.
inline constexpr int kSamples = 2;

// Throws InputError, naming `what`, when the value is outside the range.
void require_range(double value, const Range& range, const std::string& what);

// Makes the window an off-screen, anti-aliased one of that size.
void prepare_offscreen(vtkRenderWindow& window, int width_px, int height_px);

// Renders the window; `samples` by `samples` of its pixels become one of the picture.
vtkNew<vtkImageShrink3D> rendered(vtkRenderWindow& window, int samples);

// Renders the window and writes it as a PNG, beside its place first, so that no half a picture is
// left. `samples` by `samples` pixels of the window become one of the picture. Throws WriteError
// when the file cannot be written.
void render_png(vtkRenderWindow& window, const std::filesystem::path& png, int samples = 1);

}  // namespace plotscan::view
