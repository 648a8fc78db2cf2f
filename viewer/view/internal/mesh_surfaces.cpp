// SPDX-License-Identifier: Apache-2.0
#include "view/internal/mesh_surfaces.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <fmt/core.h>
#include <png.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include "core/error.h"
#include "mesh/alpha_mask.h"

namespace plotscan::view {
namespace {

const Eigen::Vector3f kPlainGreen(0.30F, 0.52F, 0.20F);

// A mesh file that states no materials is read as one without a name.
bool unpainted(const mesh::Material& material) {
  return material.name.empty() && material.texture == nullptr;
}

void require_size(std::uint64_t width, std::uint64_t height) {
  if (width * height <= mesh::AlphaMask::kMostTexels) return;
  throw InputError(fmt::format("a texture has {} x {} pixels; at most {} are drawn", width, height,
                               mesh::AlphaMask::kMostTexels));
}

// Not by VTK 9.1's reader, which crashes on a broken PNG in memory. Null where it is broken.
vtkSmartPointer<vtkImageData> decoded_png(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return nullptr;
  require_size(png.width, png.height);
  const bool transparent = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = transparent ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(static_cast<int>(png.width), static_cast<int>(png.height), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, transparent ? 4 : 3);
  // Rows from the lower edge up, as VTK has them.
  const auto stride = -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(png));
  const bool whole =
      png_image_finish_read(&png, nullptr, image->GetScalarPointer(), stride, nullptr) != 0;
  return whole ? image : nullptr;
}

vtkSmartPointer<vtkImageData> decoded_jpeg(const std::string& bytes) {
  vtkNew<vtkJPEGReader> reader;
  reader->SetMemoryBuffer(bytes.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
  reader->UpdateInformation();
  const int* const extent = reader->GetDataExtent();
  require_size(static_cast<std::uint64_t>(std::max(0, extent[1])) + 1,
               static_cast<std::uint64_t>(std::max(0, extent[3])) + 1);
  reader->Update();
  const bool whole = reader->GetErrorCode() == 0 && reader->GetOutput()->GetNumberOfPoints() > 1;
  return whole ? reader->GetOutput() : nullptr;
}

vtkSmartPointer<vtkTexture> texture_of(const mesh::Image& image) {
  const auto pixels =
      image.bytes.starts_with("\x89PNG") ? decoded_png(image.bytes) : decoded_jpeg(image.bytes);
  if (!pixels)
    throw InputError(
        fmt::format("texture {} is not a PNG or JPEG that can be decoded", image.name));
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(pixels);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOn();
  return texture;
}

vtkSmartPointer<vtkPolyData> triangles_with(const mesh::Mesh& mesh, std::uint16_t material) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3f& v : mesh.vertices) points->InsertNextPoint(v.x(), v.y(), v.z());
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (mesh.material_of(i) == material) cells->InsertNextCell({a, b, c});
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  if (!mesh.texture_coordinates.empty()) {
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    coordinates->SetName("texture");
    for (const Eigen::Vector2f& uv : mesh.texture_coordinates)
      coordinates->InsertNextTuple(uv.data());
    data->GetPointData()->SetTCoords(coordinates);
  }
  return data;
}

}  // namespace

std::vector<Surface> surfaces_of(const mesh::Mesh& mesh) {
  std::vector<Surface> surfaces;
  const std::size_t materials = std::max<std::size_t>(1, mesh.materials.size());
  for (std::uint16_t index = 0; index < materials; ++index) {
    Surface surface{.triangles = triangles_with(mesh, index), .material = {}, .texture = {}};
    if (surface.triangles->GetNumberOfPolys() == 0) continue;
    if (!mesh.materials.empty()) surface.material = mesh.materials[index];
    if (unpainted(surface.material)) surface.material.colour = kPlainGreen;
    if (surface.material.texture && !mesh.texture_coordinates.empty())
      surface.texture = texture_of(*surface.material.texture);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

void paint(vtkActor& actor, const Surface& surface) {
  const Eigen::Vector3f& colour = surface.material.colour;
  actor.GetProperty()->SetColor(colour.x(), colour.y(), colour.z());
  actor.GetProperty()->SetAmbient(0.38);
  actor.GetProperty()->SetDiffuse(0.85);
  actor.GetProperty()->SetSpecular(0);
  if (surface.texture) actor.SetTexture(surface.texture);
}

}  // namespace plotscan::view
