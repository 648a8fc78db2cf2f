// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/drone_flight.h"

#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "flight/follow.h"
#include "flight/quadrotor.h"
#include "flight/route.h"
#include "lidar/flight_plan.h"

namespace plotscan::lidar {
namespace {

// Beyond this, the steps of the cloud's float32 positions are coarser than a centimetre.
constexpr double kFarthest_m = 1e5;

flight::Pattern pattern_of(const FlyOptions& options) {
  if (options.pattern == "crosshatch") return flight::Pattern::crosshatch;
  if (options.pattern == "single") return flight::Pattern::single;
  return flight::Pattern::lawnmower;
}

std::vector<flight::Waypoint> plan(const Site& site, const Scene& scene, const FlyOptions& options,
                                   const flight::MotionLimits& limits) {
  if (options.waypoints) return plan_waypoints(scene, *options.waypoints);
  flight::StripOptions strips{.altitude_m = options.altitude_m,
                              .spacing_m = options.spacing_m,
                              .run_up_m = flight::RestToRest::run_up(options.speed_m_s, limits),
                              .pattern = pattern_of(options)};
  if (options.heading_deg) strips.heading_rad = radians(*options.heading_deg);
  return flight::waypoints_at(plan_strips(site, scene, strips));
}

// The mean wind that acts on the drone. Throws InputError if it is too strong for the drone.
double wind_on_drone(const flight::Quadrotor& quadrotor, const FlyOptions& options,
                     double speed_m_s) {
  if (!wind_moves_drone(options)) return 0;
  const double most = flight::holdable_wind_m_s(quadrotor, speed_m_s, options.wind.turbulence);
  if (options.wind.mean_m_s <= most) return options.wind.mean_m_s;
  throw InputError("--wind " + format_number(options.wind.mean_m_s) + ": at " +
                   format_number(speed_m_s) + " m/s, with gusts of " +
                   format_number(options.wind.turbulence) + " of the wind, the drone holds " +
                   fmt::format("{:.2f} m/s", std::floor(100 * most) / 100) +
                   " at most; fly slower, or let it act on plants alone (--wind-acts-on plants)");
}

void require_duration(double duration_s) {
  if (duration_s <= scan::kLongestFlight_s) return;
  throw InputError("the flight takes " + format_number(std::round(duration_s)) +
                   " s, more than 24 hours; fly faster, or wider strips");
}

scan::Trajectory planned_flight(const Site& site, const Scene& scene, const FlyOptions& options) {
  const flight::Quadrotor quadrotor;
  const double wind_m_s = wind_on_drone(quadrotor, options, options.speed_m_s);
  const std::vector<flight::Waypoint> waypoints =
      plan(site, scene, options, flight::leg_limits(quadrotor, options.speed_m_s, wind_m_s));
  for (const flight::Waypoint& waypoint : waypoints)
    wind_on_drone(quadrotor, options, waypoint.speed_m_s.value_or(options.speed_m_s));
  const flight::Route route(quadrotor, waypoints, options.speed_m_s, wind_m_s);
  require_duration(route.duration_s());
  if (!wind_moves_drone(options)) return flight::fly_exactly(quadrotor, route);
  const flight::Wind wind(wind_of(options), route.duration_s());
  return flight::follow(quadrotor, route,
                        {.velocity_m_s = [&](double time_s) { return wind.velocity_m_s(time_s); },
                         .expected_m_s = wind.mean_m_s()});
}

scan::Trajectory read_flight(const std::filesystem::path& file) {
  const scan::Trajectory read = scan::read_trajectory(file);
  scan::require_flight_time(file, read);
  std::vector<scan::StampedPose> poses = read.poses();
  for (scan::StampedPose& pose : poses) {
    if (pose.position_m.cwiseAbs().maxCoeff() > kFarthest_m)
      throw InputError(
          file, "the flight leads more than {} m from the origin; it is in the farm's local metres",
          format_number(kFarthest_m));
    pose.time_s -= read.start_s();
  }
  return scan::Trajectory(std::move(poses));
}

}  // namespace

flight::WindOptions wind_of(const FlyOptions& options) {
  flight::WindOptions wind = options.wind;
  wind.height_m = options.altitude_m;
  wind.seed = options.seed;
  return wind;
}

bool wind_moves_drone(const FlyOptions& options) {
  return options.wind.mean_m_s > 0 && options.wind_acts_on != "plants" && !options.flight;
}

bool wind_moves_plants(const FlyOptions& options) {
  return options.wind.mean_m_s > 0 && options.wind_acts_on != "drone";
}

DroneFlight fly_drone(const Site& site, const Scene& scene, const flight::PoseErrors& errors,
                      const FlyOptions& options) {
  const scan::Trajectory truth =
      options.flight ? read_flight(*options.flight) : planned_flight(site, scene, options);
  return {.truth = truth, .reported = flight::reported_trajectory(truth, errors, options.seed)};
}

double underground(const Scene& scene, const scan::Trajectory& trajectory) {
  constexpr std::size_t kMost = 1000;
  const std::vector<scan::StampedPose>& poses = trajectory.poses();
  const std::size_t step = (poses.size() + kMost - 1) / kMost;
  std::size_t seen = 0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < poses.size(); i += step, ++seen) {
    const std::optional<double> ground_m = ground_at(scene, poses[i].position_m);
    if (ground_m && poses[i].position_m.z() < *ground_m) ++below;
  }
  return static_cast<double>(below) / static_cast<double>(seen);
}

}  // namespace plotscan::lidar
