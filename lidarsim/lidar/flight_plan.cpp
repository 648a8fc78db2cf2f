// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/csv.h"
#include "core/error.h"
#include "flight/strips.h"

namespace plotscan::lidar {
namespace {

constexpr double kMaxAltitude_m = 120;    // where drones may fly without a waiver
constexpr double kClearance_m = 0.5;      // to either side of the path
constexpr double kClearanceStep_m = 0.1;  // between rays

void require_in_range(const char* name, double value, double low, double high) {
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

// Casts rays down all along a leg and beside it. Both its ends are at the same height.
void require_clear_leg(const Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr int kAside = static_cast<int>(kClearance_m / kClearanceStep_m);
  const Eigen::Vector3d way = to - from;
  const Eigen::Vector3d aside = Eigen::Vector3d(-way.y(), way.x(), 0).normalized();
  const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kClearanceStep_m)));
  const float top = scene.top_m() + 1;
  std::array<Ray, 2 * kAside + 1> rays;
  std::array<Hit, rays.size()> hits;
  for (int step = 0; step <= steps; ++step) {
    const Eigen::Vector3d place = from + way * step / steps;
    for (int k = 0; k < static_cast<int>(rays.size()); ++k) {
      const Eigen::Vector3d beside = place + (k - kAside) * kClearanceStep_m * aside;
      rays[k] = {.origin_m = {static_cast<float>(beside.x()), static_cast<float>(beside.y()), top},
                 .direction = {0, 0, -1}};
    }
    scene.cast(rays, top - static_cast<float>(from.z()), hits);
    const auto is_hit = [](const Hit& hit) { return std::isfinite(hit.range_m); };
    if (std::none_of(hits.begin(), hits.end(), is_hit)) continue;
    throw InputError("the flight would meet the ground or the crop at x " +
                     format_number(std::round(place.x())) + " m, y " +
                     format_number(std::round(place.y())) + " m; give a higher altitude");
  }
}

void require_clearance(const Scene& scene, const std::vector<Eigen::Vector3d>& path) {
  if (path.front().z() > static_cast<double>(scene.top_m())) return;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) require_clear_leg(scene, path[i], path[i + 1]);
}

}  // namespace

std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const FlightPlanOptions& options) {
  require_in_range("altitude", options.altitude_m, 0.5, kMaxAltitude_m);
  require_in_range("spacing", options.spacing_m, 0.1, 1000);
  const std::vector<Eigen::Vector3d> path =
      flight::strips_over(site.areas, {.height_m = ground_of(site) + options.altitude_m,
                                       .spacing_m = options.spacing_m,
                                       .run_up_m = options.run_up_m});
  require_clearance(scene, path);
  return path;
}

}  // namespace plotscan::lidar
