// SPDX-License-Identifier: Apache-2.0
#include "view/internal/actors.h"

#include <algorithm>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include "core/extent.h"
#include "core/statistics.h"
#include "scan/cloud_reader.h"
#include "terrain/extent.h"
#include "view/internal/mesh_surfaces.h"

namespace plotscan::view {
namespace {

// The colour bar ends at this quantile of the points, so that one stray point does not bleach all
// others.
constexpr double kTopShare = 0.999;

// One point a plant with its rotation (w, x, y, z) and scale, as vtkGlyph3DMapper wants them.
vtkNew<vtkPolyData> placements_of(const farm::Farm& farm, std::uint32_t model,
                                  farm::PlantKind kind) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> rotations;
  rotations->SetName("rotation");
  rotations->SetNumberOfComponents(4);
  vtkNew<vtkFloatArray> scales;
  scales->SetName("scale");
  scales->SetNumberOfComponents(3);
  for (const farm::Plant& plant : farm.plants) {
    if (plant.model != model || plant.kind != kind) continue;
    points->InsertNextPoint(plant.position.data());
    rotations->InsertNextTuple4(plant.rotation.w(), plant.rotation.x(), plant.rotation.y(),
                                plant.rotation.z());
    scales->InsertNextTuple(plant.scale.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->AddArray(rotations);
  data->GetPointData()->AddArray(scales);
  return data;
}

// Reddish, as pigweeds are, so that a weed shows among a crop of the same mesh.
Surface as_weed(Surface surface) {
  const Eigen::Vector3f red(0.62F, 0.20F, 0.36F);
  surface.material.colour = 0.25F * surface.material.colour + 0.75F * red;
  surface.texture = nullptr;
  return surface;
}

void add_surface(vtkRenderer& renderer, const Surface& surface, vtkPolyData* placements) {
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetSourceData(surface.triangles);
  mapper->SetInputData(placements);
  mapper->SetOrientationArray("rotation");
  mapper->SetOrientationModeToQuaternion();
  mapper->SetScaleArray("scale");
  mapper->SetScaleModeToScaleByVectorComponents();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  paint(*actor, surface);
  actor->GetProperty()->SetInterpolationToFlat();
  renderer.AddActor(actor);
}

struct ColouredPoints {
  std::vector<Eigen::Vector3f> positions;
  std::vector<double> heights_m;
};

ColouredPoints points_in_field(const std::filesystem::path& cloud, const terrain::Terrain& terrain,
                               const Field& field) {
  const Eigen::AlignedBox2d shown(field.min().head<2>(), field.max().head<2>());
  ColouredPoints points;
  scan::read_positions(cloud, [&](std::span<const Eigen::Vector3d> positions) {
    for (const Eigen::Vector3d& position : positions) {
      if (!shown.contains(position.head<2>())) continue;
      const auto ground = terrain.height(position.x(), position.y());
      if (!ground) continue;
      points.positions.push_back(position.cast<float>());
      points.heights_m.push_back(position.z() - *ground);
    }
  });
  return points;
}

// The part of the surface on the inner side of one of the field's upright sides.
vtkSmartPointer<vtkPolyData> behind_plane(vtkPolyData* surface, const Field& field, int axis,
                                          int side) {
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();
  inward[axis] = -side;
  const Eigen::Vector3d& corner = side > 0 ? field.max() : field.min();
  vtkNew<vtkPlane> plane;
  plane->SetNormal(inward.x(), inward.y(), inward.z());
  plane->SetOrigin(corner.x(), corner.y(), corner.z());
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(surface);
  clip->SetClipFunction(plane);
  clip->Update();
  return clip->GetOutput();
}

}  // namespace

Field field_of(const farm::Farm& farm, double margin_m) {
  const Eigen::AlignedBox2d extent = farm.plots.empty() ? terrain::outline_of(farm.terrain)
                                                        : extent_of(farm.plots, &farm::Plot::box);
  Eigen::AlignedBox1d heights;
  for (const farm::Plant& plant : farm.plants) {
    heights.extend(Eigen::Matrix<double, 1, 1>(plant.position.z()));
    heights.extend(Eigen::Matrix<double, 1, 1>(plant.position.z() + plant.height_m));
  }
  if (heights.isEmpty())
    for (const Eigen::Vector3d& vertex : farm.terrain.vertices())
      heights.extend(Eigen::Matrix<double, 1, 1>(vertex.z()));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  Field field;
  field.extend((Eigen::Vector3d() << extent.min() - margin, heights.min()).finished());
  field.extend((Eigen::Vector3d() << extent.max() + margin, heights.max()).finished());
  return field;
}

void add_terrain(vtkRenderer& renderer, const terrain::Terrain& terrain, const Field& field) {
  vtkSmartPointer<vtkPolyData> shown = surfaces_of(terrain::mesh_of(terrain)).front().triangles;
  for (const int axis : {0, 1})
    for (const int side : {-1, 1}) shown = behind_plane(shown, field, axis, side);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shown);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.46, 0.35, 0.25);  // soil
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.25);
  renderer.AddActor(actor);
}

void add_plants(vtkRenderer& renderer, const farm::Farm& farm) {
  for (std::uint32_t model = 0; model < farm.models.size(); ++model) {
    std::vector<Surface> surfaces = surfaces_of(farm.models[model].mesh);
    // Shades keep the plants of a mesh without materials apart.
    const float shade = 0.06F * static_cast<float>(model % 5);
    if (surfaces.size() == 1 && surfaces.front().material.name.empty())
      surfaces.front().material.colour += Eigen::Vector3f(shade, shade / 2, 0);
    for (const farm::PlantKind kind : {farm::PlantKind::crop, farm::PlantKind::weed}) {
      const auto placements = placements_of(farm, model, kind);
      if (placements->GetNumberOfPoints() == 0) continue;
      for (Surface surface : surfaces) {
        if (kind == farm::PlantKind::weed) surface = as_weed(surface);
        add_surface(renderer, surface, placements);
      }
    }
  }
}

HeightColours add_cloud(vtkRenderer& renderer, const std::filesystem::path& cloud,
                        const terrain::Terrain& terrain, const Field& field,
                        const CloudLook& look) {
  const ColouredPoints points = points_in_field(cloud, terrain, field);
  const HeightColours colours{.top_m = std::max(0.1, quantile(points.heights_m, kTopShare))};
  const std::size_t most = std::max<std::size_t>(1, look.most_points);
  const std::size_t stride = std::max<std::size_t>(1, (points.positions.size() + most - 1) / most);
  vtkNew<vtkPoints> positions;
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < points.positions.size(); i += stride) {
    const vtkIdType id = positions->InsertNextPoint(points.positions[i].data());
    const Rgb rgb = colours.of(points.heights_m[i]);
    colour->InsertNextTuple3(rgb.red, rgb.green, rgb.blue);
    cells->InsertNextCell({id});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(positions);
  data->SetVerts(cells);
  data->GetPointData()->SetScalars(colour);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetPointSize(look.point_px);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
  return colours;
}

}  // namespace plotscan::view
