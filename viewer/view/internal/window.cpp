// SPDX-License-Identifier: Apache-2.0
#include "view/internal/window.h"

#include <fmt/core.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include "core/error.h"
#include "core/output_file.h"

namespace plotscan::view {

void require_range(double value, const Range& range, const std::string& what) {
  if (!range.contains(value))
    throw InputError(fmt::format("{} {:.10g} is not in {}", what, value, range.text()));
}

void prepare_offscreen(vtkRenderWindow& window, int width_px, int height_px) {
  window.OffScreenRenderingOn();
  window.SetMultiSamples(8);
  window.SetSize(width_px, height_px);
}

vtkNew<vtkImageShrink3D> rendered(vtkRenderWindow& window, int samples) {
  window.Render();
  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(&window);
  capture->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(capture->GetOutputPort());
  shrink->SetShrinkFactors(samples, samples, 1);
  shrink->AveragingOn();
  shrink->Update();
  return shrink;
}

void render_png(vtkRenderWindow& window, const std::filesystem::path& png, int samples) {
  const auto picture = rendered(window, samples);
  OutputFile file(png, true);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(file.path().c_str());
  writer->SetCompressionLevel(9);
  writer->Write();
  if (writer->GetErrorCode() != 0) throw WriteError(file.path());
  file.commit();
}

}  // namespace plotscan::view
