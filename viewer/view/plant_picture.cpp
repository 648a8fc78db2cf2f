// SPDX-License-Identifier: Apache-2.0
#include "view/plant_picture.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "view/internal/camera.h"
#include "view/internal/display.h"
#include "view/internal/mesh_surfaces.h"
#include "view/internal/plant_layout.h"
#include "view/internal/scale.h"
#include "view/internal/window.h"

namespace plotscan::view {
namespace {

constexpr double kHeightsShowUpTo_deg = 60;  // steeper, the scale counts metres of ground
constexpr double kCreaseAngle_deg = 50;      // sharper edges are not shaded as round
constexpr double kLeastTick_px = 30;
constexpr int kLabelFont_px = 15;
constexpr int kTickFont_px = 13;
// A wide letter of the label's font.
constexpr double kLetter_px = 0.6 * kLabelFont_px;

void validate(const std::vector<PicturedPlant>& plants, const PlantPictureOptions& options) {
  using Options = PlantPictureOptions;
  require_range(options.width_px, Options::kWidth_px, "picture width");
  require_range(options.height_px, Options::kHeight_px, "picture height");
  require_range(options.elevation_deg, Options::kElevation_deg, "camera elevation in degrees");
  require_range(options.azimuth_deg, Options::kAzimuth_deg, "camera azimuth in degrees");
  require_range(options.columns, Options::kColumns, "number of columns");
  if (plants.empty()) throw InputError("there is no plant to draw");
}

PlantExtent plant_extent(const PicturedPlant& plant, const View& view) {
  PlantExtent extent;
  extent.label_px = kLetter_px * static_cast<double>(plant.label.size());
  for (const Eigen::Vector3f& vertex : plant.mesh.vertices) {
    const double x = vertex.cast<double>().dot(view.right);
    const double y = vertex.cast<double>().dot(view.up);
    extent.left_m = std::max(extent.left_m, -x);
    extent.right_m = std::max(extent.right_m, x);
    extent.above_m = std::max(extent.above_m, y);
    extent.below_m = std::max(extent.below_m, -y);
  }
  return extent;
}

void add_plant(vtkRenderer& renderer, const PicturedPlant& plant, const Eigen::Vector3d& foot) {
  for (const Surface& surface : surfaces_of(plant.mesh)) {
    vtkNew<vtkPolyDataNormals> shaded;
    shaded->SetInputData(surface.triangles);
    shaded->SetFeatureAngle(kCreaseAngle_deg);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(shaded->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(foot.x(), foot.y(), foot.z());
    paint(*actor, surface);
    renderer.AddActor(actor);
  }
}

void add_text(vtkRenderer& renderer, const std::string& text, const Eigen::Vector2d& place_px,
              int font_px, bool centred) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  vtkTextProperty& style = *actor->GetTextProperty();
  style.SetFontSize(kSamples * font_px);
  style.SetColor(0.15, 0.15, 0.15);
  style.SetVerticalJustificationToCentered();
  if (centred)
    style.SetJustificationToCentered();
  else
    style.SetJustificationToRight();
  actor->SetPosition(kSamples * place_px.x(), kSamples * place_px.y());
  renderer.AddActor2D(actor);
}

// Lines in the picture's plane.
class Lines {
 public:
  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    cells_->InsertNextCell(
        {points_->InsertNextPoint(from.data()), points_->InsertNextPoint(to.data())});
  }

  void show(vtkRenderer& renderer, double grey, float width_px) const {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_);
    data->SetLines(cells_);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(grey, grey, grey);
    actor->GetProperty()->SetLineWidth(kSamples * width_px);
    actor->GetProperty()->LightingOff();
    renderer.AddActor(actor);
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
};

// The picture's pixels as places in the world.
struct Sheet {
  View view;
  Eigen::Vector2d size_px;
  double px_per_m;
  double depth_m;  // behind every plant

  Eigen::Vector3d at(const Eigen::Vector2d& px) const {
    const Eigen::Vector2d m = (px - size_px / 2) / px_per_m;
    return m.x() * view.right + m.y() * view.up;
  }
  Eigen::Vector3d behind(double x_px, double y_px) const {
    return at({x_px, y_px}) - depth_m * view.back;
  }
};

// The ground line of a row, and lines above it at round heights, labelled at the left.
void add_scale(vtkRenderer& renderer, const Sheet& sheet, const PlantRow& row,
               double px_per_height_m) {
  const double right_px = sheet.size_px.x() - 8;
  const double left_px = kScaleWidth_px;
  const double top_m = row.above_m * sheet.px_per_m / px_per_height_m;
  const Ticks ticks = ticks_between(0, top_m, kLeastTick_px / px_per_height_m);
  Lines rulers;
  for (const double tick_m : ticks.values) {
    const double y_px = row.ground_px + tick_m * px_per_height_m;
    if (tick_m > 0) rulers.add(sheet.behind(left_px, y_px), sheet.behind(right_px, y_px));
    const char* unit = tick_m == ticks.values.back() ? " m" : "";
    add_text(renderer, ticks.text(tick_m) + unit, {left_px - 8, y_px}, kTickFont_px, false);
  }
  rulers.show(renderer, 0.86, 1);
  Lines frame;
  frame.add(sheet.behind(left_px, row.ground_px), sheet.behind(right_px, row.ground_px));
  frame.add(sheet.behind(left_px, row.ground_px),
            sheet.behind(left_px, row.ground_px + ticks.values.back() * px_per_height_m));
  frame.show(renderer, 0.35, 1.5F);
}

void aim_at(vtkRenderer& renderer, const Sheet& sheet) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetParallelScale(sheet.size_px.y() / 2 / sheet.px_per_m);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetPosition(sheet.view.back.x(), sheet.view.back.y(), sheet.view.back.z());
  camera.SetViewUp(sheet.view.up.x(), sheet.view.up.y(), sheet.view.up.z());
  renderer.ResetCameraClippingRange();
}

// Farther from its foot than any plant reaches.
double depth_behind(const std::vector<PicturedPlant>& plants) {
  float reach = 0;
  for (const PicturedPlant& plant : plants)
    for (const Eigen::Vector3f& vertex : plant.mesh.vertices)
      reach = std::max(reach, vertex.norm());
  return 1.1 * reach;
}

}  // namespace

void draw_plants(const std::vector<PicturedPlant>& plants, const std::filesystem::path& png,
                 const PlantPictureOptions& options) {
  validate(plants, options);
  const Display display;
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is thrown, not printed
  const View view = view_from({options.azimuth_deg, options.elevation_deg});
  const auto extents =
      list_of(plants, [&](const PicturedPlant& plant) { return plant_extent(plant, view); });
  const Eigen::Vector2d size_px(options.width_px, options.height_px);
  const PlantLayout layout = lay_out(extents, size_px, static_cast<std::size_t>(options.columns));
  const Sheet sheet{view, size_px, layout.px_per_m, depth_behind(plants)};

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.97, 0.97, 0.96);
  vtkNew<vtkLightKit> lights;
  lights->SetKeyToFillRatio(2);
  lights->AddLightsToRenderer(renderer);
  const double height_share = options.elevation_deg <= kHeightsShowUpTo_deg
                                  ? std::cos(options.elevation_deg * kDegrees)
                                  : 1;
  for (const PlantRow& row : layout.rows) {
    add_scale(*renderer, sheet, row, height_share * layout.px_per_m);
    for (std::size_t i = row.first; i < row.first + row.count; ++i) {
      add_plant(*renderer, plants[i], sheet.at(layout.feet[i]));
      add_text(*renderer, plants[i].label, {layout.feet[i].x(), row.label_px}, kLabelFont_px, true);
    }
  }
  aim_at(*renderer, sheet);

  vtkNew<vtkRenderWindow> window;
  prepare_offscreen(*window, kSamples * options.width_px, kSamples * options.height_px);
  window->AddRenderer(renderer);
  render_png(*window, png, kSamples);
}

}  // namespace plotscan::view
