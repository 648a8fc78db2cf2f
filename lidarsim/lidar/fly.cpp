// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly.h"

#include <memory>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/place_json.h"
#include "core/text_file.h"
#include "core/utc_time.h"
#include "lidar/fly_settings.h"
#include "lidar/internal/drone_flight.h"
#include "lidar/simulate.h"
#include "record/scan_folder.h"
#include "record/scan_formats.h"
#include "scan/cloud_writer.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::lidar {
namespace {

constexpr int kMaxThreads = 1024;

void validate(const FlyOptions& options, const sensor::Sensor& sensor) {
  if (options.sub_rays > 1 && !sensor.beam) {
    throw InputError("--sub-rays " + std::to_string(options.sub_rays) +
                     " needs a beam; the file of sensor " + sensor.name +
                     " states none (docs/beam.md)");
  }
  record::require_formats(options.formats, sensor);
  if (!parse_utc(options.start_utc))
    throw InputError("--start \"" + options.start_utc +
                     "\" must be like 2026-06-01T10:00:00Z, from 1980 to 2099");
  if (!options.part.whole() && !options.formats.empty())
    throw InputError("--format is not for a part of a flight; lidarsim join --format writes them");
  if (options.threads < 1 || options.threads > kMaxThreads)
    throw InputError("threads " + std::to_string(options.threads) + " must be in [1, 1024]");
}

std::vector<std::filesystem::path> inputs_of(const FlyOptions& options) {
  std::vector<std::filesystem::path> inputs = options.inputs;
  if (options.flight) inputs.push_back(*options.flight);
  if (options.waypoints) inputs.push_back(*options.waypoints);
  return inputs;
}

Manifest manifest_of(const Site& site, const sensor::Sensor& sensor, const FlyOptions& options,
                     const FlySummary& summary) {
  Manifest manifest{.command = "lidarsim fly", .seed = options.seed, .inputs = inputs_of(options)};
  manifest.options = settings_json(options);
  manifest.options["sensor"] = sensor.name;  // sensor.yaml holds the sensor's whole description
  if (!sensor.wedges) manifest.options["spin_hz"] = sensor::chosen_spin_hz(sensor, options.spin_hz);
  manifest.options[site.kind] = site.name;
  if (site.anchor) manifest.options["anchor"] = anchor_json(*site.anchor);
  if (options.flight) manifest.options["flight"] = options.flight->filename().string();
  if (options.waypoints) manifest.options["waypoints"] = options.waypoints->filename().string();
  if (!options.formats.empty()) manifest.options["formats"] = options.formats;
  if (!options.part.whole()) manifest.options["part"] = {options.part.number, options.part.of};
  manifest.results = {
      {"duration_s", summary.duration_s}, {"shots", summary.shots}, {"points", summary.points}};
  return manifest;
}

sensor::SpinJitter spin_jitter(const sensor::Sensor& sensor, const FlyOptions& options) {
  if (options.spin_jitter == "none") return {};
  return {.sd_rad = sensor.spin_jitter_rad, .seed = options.seed};
}

SimulateOptions simulate_options(const FlyOptions& options) {
  return {.range_noise_m = options.range_noise_m,
          .seed = options.seed,
          .threads = options.threads,
          .sub_rays = options.sub_rays,
          .returns = sensor::return_mode(options.returns).value(),
          .part = options.part};
}

// The scene with plants that sway in the flight's wind; null if nothing sways.
std::unique_ptr<const Scene> swaying_scene(const SceneContent* plants, const FlyOptions& options,
                                           double duration_s) {
  if (plants == nullptr || !wind_moves_plants(options)) return nullptr;
  return std::make_unique<const Scene>(
      *plants, Sway(options.sway, wind_of(options), duration_s, crop_of(*plants)));
}

// Writes the trajectory that was flown, the one that the drone reports, and the sensor.
void write_flight(const std::filesystem::path& folder, const DroneFlight& flight,
                  const sensor::Sensor& sensor) {
  scan::write_trajectory(folder / "trajectory.csv", flight.truth);
  scan::write_trajectory(folder / "poses.csv", flight.reported);
  write_text_file(folder / "sensor.yaml", sensor.description);
}

// What is flown over. `plants` is the content that the scene was made from, if it can sway.
struct FlownPlace {
  const Site& site;
  const Scene& scene;
  const SceneContent* plants;
};

FlySummary fly_over(const FlownPlace& place, const std::filesystem::path& scan_folder,
                    const FlyOptions& options, const ProgressReport& progress) {
  const auto& [site, scene, plants] = place;
  require_valid(options);
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor);
  validate(options, sensor);
  const double spin_hz = sensor::chosen_spin_hz(sensor, options.spin_hz);
  OutputFolder output(scan_folder, options.replace, "lidarsim fly", inputs_of(options));
  const flight::PoseErrors errors =
      flight::combined(flight::pose_error_preset(options.pose_error), options.pose_errors);
  const DroneFlight flight = fly_drone(site, scene, errors, options);
  const Eigen::Isometry3d mount = record::mount_pose(options.mount_rpy_deg.unaryExpr(&radians));
  const sensor::SpinJitter jitter = spin_jitter(sensor, options);
  const sensor::ShotPlan fired(sensor, spin_hz, flight::true_mount(mount, errors), flight.truth,
                               jitter);
  const sensor::ShotPlan placed(sensor, spin_hz, mount, flight.reported, jitter);

  const auto swaying = swaying_scene(plants, options, flight.truth.end_s());
  scan::PcdWriter cloud(output.path() / "cloud.pcd");
  const SimulateOptions how = simulate_options(options);
  simulate(
      swaying ? *swaying : scene, sensor,
      {.fired = fired, .placed = errors.none() ? fired : placed}, how,
      [&](std::span<const scan::LabelledPoint> points) { cloud.write(points); }, progress);
  cloud.close();
  write_flight(output.path(), flight, sensor);

  const SequenceRange scanned = fired_sequences(fired.sequences(), how);
  const FlySummary summary{.shots = (scanned.end - scanned.begin) * fired.lasers(),
                           .points = cloud.points(),
                           .duration_s = flight.truth.end_s(),
                           .underground = options.flight ? underground(scene, flight.truth) : 0};
  record::finish_scan(output.path(), manifest_of(site, sensor, options, summary), options.formats);
  output.commit();
  return summary;
}

}  // namespace

FlySummary fly(const Site& site, const Scene& scene, const std::filesystem::path& scan_folder,
               const FlyOptions& options, const ProgressReport& progress) {
  return fly_over({site, scene, nullptr}, scan_folder, options, progress);
}

FlySummary fly(const Site& site, const SceneContent& content,
               const std::filesystem::path& scan_folder, const FlyOptions& options,
               const ProgressReport& progress) {
  const Scene scene(content);
  return fly_over({site, scene, &content}, scan_folder, options, progress);
}

FlySummary fly(const farm::Farm& farm, const std::filesystem::path& scan_folder,
               const FlyOptions& options, const ProgressReport& progress) {
  return fly(site_of(farm), scene_content(farm), scan_folder, options, progress);
}

}  // namespace plotscan::lidar
