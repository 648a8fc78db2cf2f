// SPDX-License-Identifier: Apache-2.0
#include "record/scan_folder.h"

#include <nlohmann/json.hpp>

#include "core/angle.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/place_json.h"

namespace plotscan::record {
namespace {

using nlohmann::json;

std::optional<Anchor> anchor_of(const json& options) {
  if (!options.contains("anchor")) return std::nullopt;
  return anchor_from(options["anchor"]);
}

UtcTime start_of(const json& options) {
  const auto start = parse_utc(options.at("start_utc"));
  if (!start) throw InputError("start_utc is no time");
  return *start;
}

Eigen::Isometry3d mount_of(const json& options) {
  const json& rpy_deg = options.at("mount_rpy_deg");
  return mount_pose(
      Eigen::Vector3d(rpy_deg.at(0), rpy_deg.at(1), rpy_deg.at(2)).unaryExpr(&radians));
}

ReturnMode returns_of(const json& options) {
  const std::string mode = options.value("returns", "strongest");
  if (const auto known = sensor::return_mode(mode)) return *known;
  throw InputError("returns \"" + mode + "\" is none of strongest, last, dual");
}

}  // namespace

Eigen::Isometry3d mount_pose(const Eigen::Vector3d& rpy_rad) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return Eigen::Isometry3d(AngleAxisd(rpy_rad.z(), Vector3d::UnitZ()) *
                           AngleAxisd(rpy_rad.y(), Vector3d::UnitY()) *
                           AngleAxisd(rpy_rad.x(), Vector3d::UnitX()));
}

FlightRecord read_flight_record(const std::filesystem::path& scan_folder) {
  const json manifest = read_manifest(scan_folder);
  if (!exists(scan_folder / "sensor.yaml"))
    throw InputError(scan_folder, "is no scan folder: it has no sensor.yaml");
  try {
    const json& options = manifest.at("options");
    const sensor::Sensor sensor = sensor::load_sensor(scan_folder / "sensor.yaml");
    sensor::SpinJitter jitter;
    if (options.value("spin_jitter", "none") == "sensor")
      jitter = {.sd_rad = sensor.spin_jitter_rad, .seed = manifest.at("seed")};
    return {.sensor = sensor,
            .spin_hz = options.value("spin_hz", 0.0),
            .body_from_lidar = mount_of(options),
            .reported = scan::read_trajectory(scan_folder / "poses.csv"),
            .start = start_of(options),
            .anchor = anchor_of(options),
            .returns = returns_of(options),
            .spin_jitter = jitter};
  } catch (const json::exception&) {
    throw InputError(scan_folder, "is no scan folder (its manifest.json is not lidarsim fly's)");
  }
}

}  // namespace plotscan::record
