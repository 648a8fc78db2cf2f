// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_plan.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::lidar {
namespace {

constexpr double kMaxAltitude_m = 120;  // where drones may fly without a waiver
constexpr double kMaxPath_m = 100e3;
constexpr double kClearanceStep_m = 0.5;

void require_in_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InputError(std::string(name) + " " + format_number(value) + " m must be in [" +
                   format_number(low) + ", " + format_number(high) + "] m");
}

// The plots' direction: headings averaged as axes of four-fold symmetry, since the sides of a box
// are two directions and each is the same as its opposite.
double mean_heading(const std::vector<farm::Plot>& plots) {
  double sine = 0;
  double cosine = 0;
  for (const farm::Plot& plot : plots) {
    sine += std::sin(4 * plot.box.heading_rad);
    cosine += std::cos(4 * plot.box.heading_rad);
  }
  return std::atan2(sine, cosine) / 4;
}

// The plots' bounding rectangle in axes along and across the strips.
struct Field {
  Eigen::Rotation2Dd world_from_field{0};
  Eigen::AlignedBox2d bounds;
};

Field field_with_heading(const std::vector<farm::Plot>& plots, double heading_rad) {
  Field field{.world_from_field = Eigen::Rotation2Dd(heading_rad), .bounds = {}};
  for (const farm::Plot& plot : plots) {
    for (const Eigen::Vector2d& corner : plot.box.corners())
      field.bounds.extend(field.world_from_field.inverse() * corner);
  }
  return field;
}

Field field_along_longer_side(const std::vector<farm::Plot>& plots) {
  const double heading = mean_heading(plots);
  const Field field = field_with_heading(plots, heading);
  const Eigen::Vector2d sides = field.bounds.sizes();
  return sides.x() >= sides.y() ? field : field_with_heading(plots, heading + EIGEN_PI / 2);
}

double mean_ground(const farm::Farm& farm) {
  double sum = 0;
  int count = 0;
  const auto add = [&](const Eigen::Vector2d& place) {
    const auto height = farm.terrain.height(place.x(), place.y());
    if (!height) return;
    sum += *height;
    ++count;
  };
  for (const farm::Plot& plot : farm.plots) {
    add(plot.box.center);
    for (const Eigen::Vector2d& corner : plot.box.corners()) add(corner);
  }
  if (count == 0) throw InputError("no plot of the farm lies on its terrain");
  return sum / count;
}

void require_clearance(const farm::Farm& farm, const std::vector<Eigen::Vector3d>& path) {
  double tallest_plant = 0;
  for (const farm::Plant& plant : farm.plants)
    tallest_plant = std::max(tallest_plant, plant.height_m);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector3d way = path[i + 1] - path[i];
    const int steps = static_cast<int>(std::ceil(way.norm() / kClearanceStep_m));
    for (int step = 0; step <= steps; ++step) {
      const Eigen::Vector3d place = path[i] + way * step / std::max(steps, 1);
      const auto ground = farm.terrain.height(place.x(), place.y());
      if (!ground || place.z() > *ground + tallest_plant) continue;
      throw InputError("the flight would meet the ground or the crop at x " +
                       format_number(std::round(place.x())) + " m, y " +
                       format_number(std::round(place.y())) + " m; give a higher altitude");
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3d> plan_strips(const farm::Farm& farm, const FlightPlanOptions& options) {
  require_in_range("altitude", options.altitude_m, 0.5, kMaxAltitude_m);
  require_in_range("spacing", options.spacing_m, 0.1, 1000);
  if (farm.plots.empty())
    throw InputError("the farm has no plots to fly over; give a trajectory with --flight");
  const Field field = field_along_longer_side(farm.plots);
  const Eigen::Vector2d sides = field.bounds.sizes();
  const double strips = std::max(1.0, std::ceil(sides.y() / options.spacing_m));
  const double strip_m = sides.x() + 2 * options.run_up_m;
  if (strips * (strip_m + options.spacing_m) > kMaxPath_m) {
    throw InputError("the flight would be longer than " + format_number(kMaxPath_m / 1000) +
                     " km; give a wider spacing");
  }
  const double z = mean_ground(farm) + options.altitude_m;
  std::vector<Eigen::Vector3d> path;
  for (int strip = 0; strip < static_cast<int>(strips); ++strip) {
    const double across =
        field.bounds.center().y() + (strip - (strips - 1) / 2) * options.spacing_m;
    const double forth = strip % 2 == 0 ? 1 : -1;
    for (const double end : {-forth, forth}) {
      const Eigen::Vector2d place =
          field.world_from_field *
          Eigen::Vector2d(field.bounds.center().x() + end * strip_m / 2, across);
      path.emplace_back(place.x(), place.y(), z);
    }
  }
  require_clearance(farm, path);
  return path;
}

}  // namespace plotscan::lidar
