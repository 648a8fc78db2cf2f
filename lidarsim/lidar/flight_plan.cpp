// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/csv.h"
#include "core/error.h"
#include "flight/waypoint_file.h"

namespace plotscan::lidar {
namespace {

constexpr double kMinAltitude_m = 0.5;
constexpr double kMaxAltitude_m = 120;    // where drones may fly without a waiver
constexpr double kClearance_m = 0.5;      // to either side of the path
constexpr double kClearanceStep_m = 0.1;  // between rays
constexpr double kLeastLeg_m = 1e-3;

void require_within(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InputError(std::string(name) + " " + format_number(value) + " m must be in [" +
                   format_number(low) + ", " + format_number(high) + "] m");
}

double ground_of(const Site& site) {
  if (site.areas.empty()) {
    throw InputError("the " + site.kind +
                     " has no plots to fly over; give a trajectory with --flight");
  }
  if (!site.ground_m) throw InputError("no plot of the " + site.kind + " lies on its terrain");
  return *site.ground_m;
}

// Casts rays down along a leg and on both sides of it; the unit vector `aside` points sideways.
void require_clear_beside(const Scene& scene, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& way, const Eigen::Vector3d& aside) {
  constexpr int kAside = static_cast<int>(kClearance_m / kClearanceStep_m);
  const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kClearanceStep_m)));
  const float top = scene.top_m() + 1;
  std::array<Ray, 2 * kAside + 1> rays;
  std::array<Hit, rays.size()> hits;
  for (int step = 0; step <= steps; ++step) {
    const Eigen::Vector3d place = from + way * step / steps;
    if (place.z() >= static_cast<double>(top)) continue;
    for (int k = 0; k < static_cast<int>(rays.size()); ++k) {
      const Eigen::Vector3d beside = place + (k - kAside) * kClearanceStep_m * aside;
      rays[k] = {.origin_m = {static_cast<float>(beside.x()), static_cast<float>(beside.y()), top},
                 .direction = {0, 0, -1}};
    }
    scene.cast(rays, top - static_cast<float>(place.z()), hits);
    const auto is_hit = [](const Hit& hit) { return std::isfinite(hit.range_m); };
    if (std::none_of(hits.begin(), hits.end(), is_hit)) continue;
    throw InputError("the flight would meet the ground or the crop at x " +
                     format_number(std::round(place.x())) + " m, y " +
                     format_number(std::round(place.y())) + " m; give a higher altitude");
  }
}

void require_clear_leg(const Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d way = to - from;
  if (way.head<2>().norm() > 0) {
    require_clear_beside(scene, from, way, Eigen::Vector3d(-way.y(), way.x(), 0).normalized());
    return;
  }
  require_clear_beside(scene, from, way, Eigen::Vector3d::UnitX());
  require_clear_beside(scene, from, way, Eigen::Vector3d::UnitY());
}

void require_clearance(const Scene& scene, const std::vector<Eigen::Vector3d>& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double lowest_m = std::min(path[i].z(), path[i + 1].z());
    if (lowest_m <= static_cast<double>(scene.top_m()))
      require_clear_leg(scene, path[i], path[i + 1]);
  }
}

std::string name_of(std::size_t waypoint) { return "waypoint " + std::to_string(waypoint + 1); }

flight::Waypoint placed(const Scene& scene, const flight::StatedWaypoint& stated) {
  flight::Waypoint waypoint = stated.waypoint;
  const std::optional<double> ground_m = ground_at(scene, waypoint.position_m);
  if (stated.altitude_m) {
    if (!ground_m) throw InputError("no ground lies below it; give z_m in place of altitude_m");
    waypoint.position_m.z() = *ground_m + *stated.altitude_m;
  } else if (ground_m) {
    const double altitude_m = waypoint.position_m.z() - *ground_m;
    require_within("its height over the ground below", altitude_m, kMinAltitude_m, kMaxAltitude_m);
  }
  return waypoint;
}

void require_path(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& path) {
  double length_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double leg_m = (path[i] - path[i - 1]).norm();
    if (leg_m < kLeastLeg_m)
      throw InputError(file, name_of(i) + " is where the one before it is; to wait, give hold_s");
    length_m += leg_m;
  }
  if (length_m > flight::kMaxPath_m) {
    throw InputError(file, "the flight would be {} m long; at most {} km are allowed",
                     format_number(std::round(length_m)), format_number(flight::kMaxPath_m / 1000));
  }
}

}  // namespace

std::optional<double> ground_at(const Scene& scene, const Eigen::Vector3d& place) {
  constexpr float kPastSurface_m = 1e-3F;
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  float z = scene.top_m() + 1;
  while (z > scene.bottom_m()) {
    const Ray ray{.origin_m = {static_cast<float>(place.x()), static_cast<float>(place.y()), z},
                  .direction = {0, 0, -1}};
    Hit hit;
    scene.cast({&ray, 1}, z - scene.bottom_m() + 1, {&hit, 1});
    if (!std::isfinite(hit.range_m)) return std::nullopt;
    if (scene.surface(hit).label == scan::PointClass::ground)
      return static_cast<double>(z - hit.range_m);
    const float surface_z = z - hit.range_m;
    // Far from the origin a float's step may exceed a millimetre.
    z = std::min(surface_z - kPastSurface_m, std::nextafter(surface_z, -kEndless));
  }
  return std::nullopt;
}

std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const flight::StripOptions& options) {
  require_within("altitude", options.altitude_m, kMinAltitude_m, kMaxAltitude_m);
  require_within("spacing", options.spacing_m, 0.1, 1000);
  std::vector<Eigen::Vector3d> path = flight::strips_over(site.areas, ground_of(site), options);
  require_clearance(scene, path);
  return path;
}

std::vector<flight::Waypoint> plan_waypoints(const Scene& scene,
                                             const std::filesystem::path& file) {
  const std::vector<flight::StatedWaypoint> stated = flight::read_waypoints(file);
  std::vector<flight::Waypoint> waypoints;
  std::vector<Eigen::Vector3d> path;
  for (std::size_t i = 0; i < stated.size(); ++i) {
    try {
      waypoints.push_back(placed(scene, stated[i]));
    } catch (const InputError& error) {
      throw InputError(file, name_of(i) + ": " + error.what());
    }
    path.push_back(waypoints.back().position_m);
  }
  require_path(file, path);
  require_clearance(scene, path);
  return waypoints;
}

}  // namespace plotscan::lidar
