// SPDX-License-Identifier: Apache-2.0
#include "view/internal/panel.h"

#include <cstddef>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>

#include "view/internal/window.h"

namespace plotscan::view {
namespace {

constexpr unsigned kShadeSamples = 64;
constexpr double kShadeBias = 0.02;  // of the reach: nearer things are the surface itself

Raster raster_of(vtkImageData& image) {
  const int* size = image.GetDimensions();
  Raster raster{.width = size[0], .height = size[1]};
  const auto* bytes = static_cast<const std::uint8_t*>(image.GetScalarPointer());
  const auto channels = static_cast<std::size_t>(image.GetNumberOfScalarComponents());
  const auto pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* at = bytes + i * channels;
    raster.pixels.push_back({at[0], at[1], at[2]});
  }
  return raster;
}

}  // namespace

Raster drawn_panel(vtkRenderer& renderer, const Eigen::Vector2i& size_px, double shade_m) {
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> shade;
  if (shade_m > 0) {
    shade->SetRadius(shade_m);
    shade->SetBias(kShadeBias * shade_m);
    shade->SetKernelSize(kShadeSamples);
    shade->BlurOn();
    shade->SetDelegatePass(steps);
    renderer.SetPass(shade);
  }
  vtkNew<vtkRenderWindow> window;
  prepare_offscreen(*window, kPanelSamples * size_px.x(), kPanelSamples * size_px.y());
  window->AddRenderer(&renderer);
  Raster raster = raster_of(*rendered(*window, kPanelSamples)->GetOutput());
  renderer.SetPass(nullptr);
  return raster;
}

}  // namespace plotscan::view
