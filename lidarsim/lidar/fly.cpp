// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/text.h"
#include "core/text_file.h"
#include "core/utc_time.h"
#include "flight/follow.h"
#include "flight/quadrotor.h"
#include "flight/route.h"
#include "lidar/flight_plan.h"
#include "lidar/fly_settings.h"
#include "lidar/simulate.h"
#include "lidar/sway.h"
#include "record/scan_folder.h"
#include "record/scan_formats.h"
#include "scan/cloud_writer.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::lidar {
namespace {

constexpr double kMaxFlight_s = 24 * 3600;
constexpr int kMaxThreads = 1024;

void validate(const FlyOptions& options, const sensor::Sensor& sensor) {
  if (options.sub_rays > 1 && !sensor.beam) {
    throw InputError("--sub-rays " + std::to_string(options.sub_rays) +
                     " needs a beam; the file of sensor " + sensor.name +
                     " states none (docs/beam.md)");
  }
  record::require_formats(options.formats, sensor);
  if (!parse_utc(options.start_utc))
    throw InputError("--start \"" + options.start_utc + "\" must be like 2026-06-01T10:00:00Z");
  if (options.threads < 1 || options.threads > kMaxThreads)
    throw InputError("threads " + std::to_string(options.threads) + " must be in [1, 1024]");
}

flight::Pattern pattern_of(const FlyOptions& options) {
  if (options.pattern == "crosshatch") return flight::Pattern::crosshatch;
  if (options.pattern == "single") return flight::Pattern::single;
  return flight::Pattern::lawnmower;
}

std::vector<flight::Waypoint> plan(const Site& site, const Scene& scene, const FlyOptions& options,
                                   const flight::MotionLimits& limits) {
  if (options.waypoints) return plan_waypoints(scene, *options.waypoints);
  FlightPlanOptions strips{.altitude_m = options.altitude_m,
                           .spacing_m = options.spacing_m,
                           .run_up_m = flight::RestToRest::run_up(options.speed_m_s, limits),
                           .pattern = pattern_of(options)};
  if (options.heading_deg) strips.heading_rad = *options.heading_deg * std::numbers::pi / 180;
  return flight::waypoints_at(plan_strips(site, scene, strips));
}

// The wind that tilts the drone, which must hold it.
double wind_on_drone(const flight::Quadrotor& quadrotor, const FlyOptions& options,
                     double speed_m_s) {
  if (!wind_moves_drone(options)) return 0;
  const double most = flight::holdable_wind_m_s(quadrotor, speed_m_s, options.wind.turbulence);
  if (options.wind.mean_m_s <= most) return options.wind.mean_m_s;
  throw InputError("--wind " + format_number(options.wind.mean_m_s) + ": at " +
                   format_number(speed_m_s) + " m/s, with gusts of " +
                   format_number(options.wind.turbulence) + " of the wind, the drone holds " +
                   formatted("%.2f m/s", std::floor(100 * most) / 100) +
                   " at most; fly slower, or let it act on plants alone (--wind-acts-on plants)");
}

void require_duration(double duration_s) {
  if (duration_s <= kMaxFlight_s) return;
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
  if (read.end_s() - read.start_s() > kMaxFlight_s) {
    throw InputError(file, "the flight takes " + format_number(read.end_s() - read.start_s()) +
                               " s; at most " + format_number(kMaxFlight_s) + " s are allowed");
  }
  std::vector<scan::StampedPose> poses = read.poses();
  for (scan::StampedPose& pose : poses) pose.time_s -= read.start_s();
  return scan::Trajectory(std::move(poses));
}

// The drone's way as it was, and as it reports it.
struct Flight {
  scan::Trajectory truth;
  scan::Trajectory reported;
};

Flight fly_drone(const Site& site, const Scene& scene, const flight::PoseErrors& errors,
                 const FlyOptions& options) {
  const scan::Trajectory truth =
      options.flight ? read_flight(*options.flight) : planned_flight(site, scene, options);
  return {.truth = truth, .reported = flight::reported_trajectory(truth, errors, options.seed)};
}

Manifest manifest_of(const Site& site, const sensor::Sensor& sensor, const FlyOptions& options,
                     const FlySummary& summary) {
  Manifest manifest{.command = "lidarsim fly", .seed = options.seed, .inputs = options.inputs};
  manifest.options = settings_json(options);
  manifest.options["sensor"] = sensor.name;  // sensor.yaml has all of it
  if (!sensor.wedges) manifest.options["spin_hz"] = sensor::chosen_spin_hz(sensor, options.spin_hz);
  manifest.options[site.kind] = site.name;
  if (site.anchor) {
    manifest.options["anchor"] = {{"latitude_deg", site.anchor->latitude_deg},
                                  {"longitude_deg", site.anchor->longitude_deg},
                                  {"altitude_m", site.anchor->altitude_m}};
  }
  if (options.flight) {
    manifest.options["flight"] = options.flight->filename().string();
    manifest.inputs.push_back(*options.flight);
  }
  if (options.waypoints) {
    manifest.options["waypoints"] = options.waypoints->filename().string();
    manifest.inputs.push_back(*options.waypoints);
  }
  if (!options.formats.empty()) manifest.options["formats"] = options.formats;
  manifest.results = {
      {"duration_s", summary.duration_s}, {"shots", summary.shots}, {"points", summary.points}};
  return manifest;
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

namespace {

// The scene in the wind of the flight; null where nothing sways.
std::unique_ptr<const Scene> swaying_scene(const SceneContent* plants, const FlyOptions& options,
                                           double duration_s) {
  if (plants == nullptr || !wind_moves_plants(options)) return nullptr;
  return std::make_unique<const Scene>(
      *plants, Sway(options.sway, wind_of(options), duration_s, crop_of(*plants)));
}

// `plants`: what the scene was made from, where it can sway.
FlySummary fly_over(const Site& site, const Scene& scene, const SceneContent* plants,
                    const std::filesystem::path& scan_folder, const FlyOptions& options,
                    bool replace, const ProgressReport& progress) {
  require_valid(options);
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor);
  validate(options, sensor);
  const double spin_hz = sensor::chosen_spin_hz(sensor, options.spin_hz);
  OutputFolder output(scan_folder, replace, "lidarsim fly");
  const flight::PoseErrors errors =
      flight::combined(flight::pose_error_preset(options.pose_error), options.pose_errors);
  const Flight flight = fly_drone(site, scene, errors, options);
  const Eigen::Isometry3d mount =
      record::mount_pose(options.mount_rpy_deg * std::numbers::pi / 180);
  const sensor::ShotPlan fired(sensor, spin_hz, flight::true_mount(mount, errors), flight.truth);
  const sensor::ShotPlan placed(sensor, spin_hz, mount, flight.reported);

  const auto swaying = swaying_scene(plants, options, flight.truth.end_s());
  scan::PcdWriter cloud(output.path() / "cloud.pcd");
  simulate(
      swaying ? *swaying : scene, sensor,
      {.fired = fired, .placed = errors.none() ? fired : placed},
      {.range_noise_m = options.range_noise_m,
       .seed = options.seed,
       .threads = options.threads,
       .sub_rays = options.sub_rays,
       .returns = return_mode(options.returns)},
      [&](std::span<const scan::LabelledPoint> points) { cloud.write(points); }, progress);
  cloud.close();
  scan::write_trajectory(output.path() / "trajectory.csv", flight.truth);
  scan::write_trajectory(output.path() / "poses.csv", flight.reported);
  TextFile description(output.path() / "sensor.yaml");
  description << sensor.description;
  description.close();

  const FlySummary summary{.shots = fired.sequences() * fired.lasers(),
                           .points = cloud.points(),
                           .duration_s = flight.truth.end_s()};
  const Manifest manifest = manifest_of(site, sensor, options, summary);
  write_manifest(output.path(), manifest);
  if (!options.formats.empty()) {
    // They are made of the whole folder, and the manifest lists them, too.
    record::write_formats(options.formats, output.path());
    write_manifest(output.path(), manifest);
  }
  output.commit();
  return summary;
}

}  // namespace

FlySummary fly(const Site& site, const Scene& scene, const std::filesystem::path& scan_folder,
               const FlyOptions& options, bool replace, const ProgressReport& progress) {
  return fly_over(site, scene, nullptr, scan_folder, options, replace, progress);
}

FlySummary fly(const farm::Farm& farm, const std::filesystem::path& scan_folder,
               const FlyOptions& options, bool replace, const ProgressReport& progress) {
  const SceneContent content = scene_content(farm);
  return fly_over(site_of(farm), Scene(content), &content, scan_folder, options, replace, progress);
}

}  // namespace plotscan::lidar
