// SPDX-License-Identifier: Apache-2.0
#include "view/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "view/actors.h"
#include "view/display.h"
#include "view/window.h"

namespace plotscan::view {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kViewAngleDeg = 24;
// Room left around the field.
constexpr double kAir = 1.03;

void validate(const PictureOptions& options) {
  require_range(options.width_px, kPictureSize_px, "picture width");
  require_range(options.height_px, kPictureSize_px, "picture height");
  require_range(options.elevation_deg, {5, 90}, "camera elevation in degrees");
  require_range(options.azimuth_deg, {-360, 360}, "camera azimuth in degrees");
  require_range(options.margin_m, {0, 1e4}, "margin in metres");
}

// Looks at the field's centre from as near as shows all of it.
void aim(vtkRenderer& renderer, const Field& field, const PictureOptions& options, double aspect) {
  const double azimuth = options.azimuth_deg * kDegrees;
  const double elevation = options.elevation_deg * kDegrees;
  const Eigen::Vector3d back(std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0);
  const Eigen::Vector3d up = back.cross(right);
  const double up_slope = std::tan(kViewAngleDeg / 2 * kDegrees);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = field.corner(static_cast<Field::CornerType>(i)) - field.center();
    const double wide = std::abs(corner.dot(right)) / (up_slope * aspect);
    const double high = std::abs(corner.dot(up)) / up_slope;
    distance = std::max(distance, corner.dot(back) + kAir * std::max(wide, high));
  }
  const Eigen::Vector3d target = field.center();
  const Eigen::Vector3d eye = target + distance * back;
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetFocalPoint(target.x(), target.y(), target.z());
  camera.SetPosition(eye.x(), eye.y(), eye.z());
  camera.SetViewUp(up.x(), up.y(), up.z());
  camera.SetViewAngle(kViewAngleDeg);
  renderer.ResetCameraClippingRange();
}

}  // namespace

void draw_picture(const farm::Farm& farm, const std::optional<std::filesystem::path>& cloud,
                  const std::vector<PlotBox>& boxes, const std::filesystem::path& png,
                  const PictureOptions& options) {
  validate(options);
  const Display display;
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is thrown, not printed
  const Field field = field_of(farm, options.margin_m);
  const int panels = cloud ? 2 : 1;
  const double aspect = static_cast<double>(options.width_px) / panels / options.height_px;

  vtkNew<vtkRenderer> farm_panel;
  farm_panel->SetBackground(1, 1, 1);
  farm_panel->SetViewport(0, 0, 1.0 / panels, 1);
  add_terrain(*farm_panel, farm.terrain, field);
  add_plants(*farm_panel, farm);
  aim(*farm_panel, field, options, aspect);

  vtkNew<vtkRenderWindow> window;
  prepare_offscreen(*window, options.width_px, options.height_px);
  window->AddRenderer(farm_panel);

  vtkNew<vtkRenderer> cloud_panel;
  if (cloud) {
    cloud_panel->SetBackground(1, 1, 1);
    cloud_panel->SetViewport(0.5, 0, 1, 1);
    add_cloud(*cloud_panel, *cloud, farm.terrain, field, options.max_points);
    add_boxes(*cloud_panel, boxes, farm.terrain);
    aim(*cloud_panel, field, options, aspect);
    window->AddRenderer(cloud_panel);
  }
  render_png(*window, png);
}

}  // namespace plotscan::view
