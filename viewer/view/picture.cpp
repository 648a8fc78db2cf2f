// SPDX-License-Identifier: Apache-2.0
#include "view/picture.h"

#include <algorithm>
#include <cmath>

#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkRenderer.h>

#include "view/internal/actors.h"
#include "view/internal/camera.h"
#include "view/internal/display.h"
#include "view/internal/page.h"
#include "view/internal/panel.h"
#include "view/internal/window.h"

namespace plotscan::view {
namespace {

const Stroke kBoxLine{.colour = kVermilion, .width_px = 1.8};
constexpr double kText_px = 15;
constexpr double kLegend_px = 100;  // of the picture's width
constexpr double kShade_m = 0.4;    // as far as leaves darken the soil and each other
constexpr int kPlaces = 17;         // along either side of the field, of its ground that is shown

void validate(const PictureOptions& options) {
  using Options = PictureOptions;
  require_range(options.width_px, Options::kWidth_px, "picture width");
  require_range(options.height_px, Options::kHeight_px, "picture height");
  require_range(options.elevation_deg, Options::kElevation_deg, "camera elevation in degrees");
  require_range(options.azimuth_deg, Options::kAzimuth_deg, "camera azimuth in degrees");
  require_range(options.margin_m, Options::kMargin_m, "margin in metres");
}

// The field's ground and its plots as high as the tallest plant.
std::vector<Eigen::Vector3d> outline_of(const farm::Farm& farm, const Field& field) {
  std::vector<Eigen::Vector3d> places;
  const auto add = [&](const Eigen::Vector2d& place, double above_m) {
    const auto ground_m = farm.terrain.height(place.x(), place.y());
    if (ground_m) places.emplace_back(place.x(), place.y(), *ground_m + above_m);
  };
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const Eigen::Vector2d share(i / (kPlaces - 1.0), j / (kPlaces - 1.0));
      add(field.min().head<2>() + share.cwiseProduct(field.sizes().head<2>()), 0);
    }
  }
  double tallest_m = 0;
  for (const farm::Plant& plant : farm.plants) tallest_m = std::max(tallest_m, plant.height_m);
  for (const farm::Plot& plot : farm.plots)
    for (const Eigen::Vector2d& corner : plot.box.corners()) add(corner, tallest_m);
  if (places.empty()) places = {field.min(), field.max()};
  return places;
}

// The box on the ground, closed; pixels of a panel that begins at left_px.
std::vector<Eigen::Vector2d> outline_in_picture(const PlotBox& box, const terrain::Terrain& terrain,
                                                const Camera& camera,
                                                const Eigen::Vector2i& size_px, double left_px) {
  std::vector<Eigen::Vector2d> outline;
  for (const Eigen::Vector2d& corner : box.corners()) {
    const double z = terrain.height(corner.x(), corner.y()).value_or(0);
    const Eigen::Vector2d place = camera.project({corner.x(), corner.y(), z});
    outline.emplace_back(Eigen::Vector2d(left_px, 0) +
                         (place.array() + 1).matrix().cwiseProduct(size_px.cast<double>()) / 2);
  }
  outline.push_back(outline.front());
  return outline;
}

void add_light(vtkRenderer& renderer, const Eigen::Vector3d& from, double intensity) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(from.x(), from.y(), from.z());
  light->SetFocalPoint(0, 0, 0);
  light->SetIntensity(intensity);
  renderer.AddLight(light);
}

// A high sun to the camera's left, and the sky.
void light_up(vtkRenderer& renderer, const Camera& camera) {
  add_light(renderer, camera.back - 1.5 * camera.right + 2 * Eigen::Vector3d::UnitZ(), 1.15);
  add_light(renderer, camera.back + camera.right, 0.5);
}

vtkNew<vtkRenderer> white_renderer() {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  return renderer;
}

Raster farm_panel(const farm::Farm& farm, const Field& field, const Camera& camera,
                  const Eigen::Vector2i& size_px) {
  const auto renderer = white_renderer();
  add_terrain(*renderer, farm.terrain, field);
  add_plants(*renderer, farm);
  light_up(*renderer, camera);
  aim(*renderer, camera);
  return drawn_panel(*renderer, size_px, kShade_m);
}

}  // namespace

void draw_picture(const farm::Farm& farm, const std::optional<std::filesystem::path>& cloud,
                  const std::vector<PlotBox>& boxes, const std::filesystem::path& png,
                  const PictureOptions& options) {
  validate(options);
  const Display display;
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is thrown, not printed
  const Field field = field_of(farm, options.margin_m);
  const int panel_px =
      cloud ? static_cast<int>(options.width_px - kLegend_px) / 2 : options.width_px;
  const Camera camera =
      camera_that_sees(outline_of(farm, field), {options.azimuth_deg, options.elevation_deg},
                       static_cast<double>(panel_px) / options.height_px);
  const Eigen::Vector2i size_px(
      panel_px, static_cast<int>(std::ceil(panel_px * camera.up_slope / camera.right_slope)));

  Page page(Eigen::Vector2d(options.width_px, size_px.y()));
  page.raster({0, 0}, farm_panel(farm, field, camera, size_px));
  if (cloud) {
    const auto renderer = white_renderer();
    const HeightColours colours =
        add_cloud(*renderer, *cloud, farm.terrain, field,
                  {.most_points = options.max_points, .point_px = kPanelSamples + 1});
    aim(*renderer, camera);
    page.raster(Eigen::Vector2d(panel_px, 0), drawn_panel(*renderer, size_px, 0));
    for (const PlotBox& box : boxes)
      page.line(outline_in_picture(box, farm.terrain, camera, size_px, panel_px), kBoxLine);
    const Eigen::Vector2d corner(2 * panel_px + kText_px, 0.15 * size_px.y());
    draw_colour_bar(page, colours, {corner, corner + Eigen::Vector2d(kText_px, 0.7 * size_px.y())},
                    "height (m)", kText_px);
  }
  page.write(png);
}

}  // namespace plotscan::view
