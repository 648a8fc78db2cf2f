// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly_settings.h"

#include <utility>

#include "lidar/internal/beam.h"
#include "sensor/return_mode.h"

namespace plotscan::lidar {
namespace {

constexpr const char* kWind = "Wind (docs/flight.md, docs/sway.md)";
constexpr const char* kBeam = "Beam (docs/beam.md)";
constexpr const char* kPoseErrors = "Pose errors (docs/pose-errors.md)";

template <auto Error>
auto& pose_error(FlyOptions& options) {
  return options.pose_errors.*Error;
}

}  // namespace

// A table may be long. NOLINTNEXTLINE(readability-function-size)
const std::vector<FlySetting>& fly_settings() {
  static const std::vector<FlySetting> settings = {
      {.key = "sensor",
       .flag = "--sensor",
       .help = "a shipped sensor's name, or the file of your own (docs/sensors.md)",
       .value = TextSetting{{}, member<&FlyOptions::sensor>}},
      {.key = "altitude_m",
       .flag = "--altitude",
       .help = "metres above the mean ground of the plots, 0.5 to 120",
       .value = NumberSetting{{0.5, 120}, member<&FlyOptions::altitude_m>},
       .plans = Plan::strips},
      {.key = "speed_m_s",
       .flag = "--speed",
       .help = "of flight, metres per second, 0.01 to 6",
       .value = NumberSetting{{0.01, 6}, member<&FlyOptions::speed_m_s>},
       .plans = Plan::flight},
      {.key = "spacing_m",
       .flag = "--spacing",
       .help = "metres between neighbouring strips, 0.1 to 1000",
       .value = NumberSetting{{0.1, 1000}, member<&FlyOptions::spacing_m>},
       .plans = Plan::strips},
      {.key = "pattern",
       .flag = "--pattern",
       .help = "lawnmower: parallel strips; crosshatch: also strips across them; single: one strip",
       .value = TextSetting{{"lawnmower", "crosshatch", "single"}, member<&FlyOptions::pattern>},
       .plans = Plan::strips},
      {.key = "heading_deg",
       .flag = "--heading",
       .help =
           "of the strips, degrees counter-clockwise from east, -360 to 360 (default: along the "
           "longer side of the field)",
       .value = OptionalSetting{{-360, 360}, member<&FlyOptions::heading_deg>},
       .plans = Plan::strips},
      {.key = "spin_hz",
       .flag = "--spin",
       .help =
           "rotations of the sensor per second (default: the sensor's own, see lidarsim sensors)",
       .value = OptionalSetting{{0.01, 1000}, member<&FlyOptions::spin_hz>}},
      {.key = "range_noise_m",
       .flag = "--noise",
       .help = "standard deviation of the range noise, metres, 0 to 1",
       .value = NumberSetting{{0, 1}, member<&FlyOptions::range_noise_m>}},
      {.key = "spin_jitter",
       .flag = "--spin-jitter",
       .help = "of the sensor's azimuth: as the sensor's file states, or none (docs/sensors.md)",
       .value = TextSetting{{"sensor", "none"}, member<&FlyOptions::spin_jitter>}},
      {.key = "wind_m_s",
       .flag = "--wind",
       .help = "mean wind, metres per second, 0 to 30",
       .value = NumberSetting{{0, 30}, member<&FlyOptions::wind, &flight::WindOptions::mean_m_s>},
       .group = kWind},
      {.key = "wind_from_deg",
       .flag = "--wind-from",
       .help =
           "where the wind blows from, degrees clockwise from north, 0 to 360: 270 is a west wind",
       .value = NumberSetting{{0, 360}, member<&FlyOptions::wind, &flight::WindOptions::from_deg>},
       .group = kWind},
      {.key = "wind_turbulence",
       .flag = "--wind-turbulence",
       .help = "standard deviation of the gusts as a share of the mean wind, 0 to 1",
       .value = NumberSetting{{0, 1}, member<&FlyOptions::wind, &flight::WindOptions::turbulence>},
       .group = kWind},
      {.key = "wind_acts_on",
       .flag = "--wind-acts-on",
       .help = "what the wind moves",
       .value = TextSetting{{"both", "drone", "plants"}, member<&FlyOptions::wind_acts_on>},
       .group = kWind},
      {.key = "sway_deg_at_5m_s",
       .flag = "--sway",
       .help =
           "how far plants lean in 5 m/s of wind at their tops, degrees, 0 to 40 (docs/sway.md)",
       .value = NumberSetting{{0, 40}, member<&FlyOptions::sway, &SwayOptions::lean_deg_at_5m_s>},
       .group = kWind},
      {.key = "sway_hz_at_1m",
       .flag = "--sway-frequency",
       .help = "natural frequency of a plant of 1 m, hertz, 0.01 to 20; others swing at it / "
               "sqrt(height)",
       .value = NumberSetting{{0.01, 20}, member<&FlyOptions::sway, &SwayOptions::hz_at_1m>},
       .group = kWind},
      {.key = "sway_swing",
       .flag = "--sway-swing",
       .help = "amplitude of the plants' swinging as a share of their lean, 0 to 1",
       .value = NumberSetting{{0, 1}, member<&FlyOptions::sway, &SwayOptions::swing>},
       .group = kWind},
      {.key = "sub_rays",
       .flag = "--sub-rays",
       .help = "rays that sample a beam, 1 (its axis alone) to 1024 (docs/beam.md)",
       .value = WholeSetting{{1, kMaxSubRays}, member<&FlyOptions::sub_rays>},
       .group = kBeam},
      {.key = "returns",
       .flag = "--returns",
       .help = "which returns of a shot are kept, where --sub-rays is more than 1",
       .value = TextSetting{sensor::return_mode_names(), member<&FlyOptions::returns>},
       .group = kBeam},
      {.key = "start_utc",
       .flag = "--start",
       .help = "start of the flight, UTC, 1980 to 2099, for GPS times and ROS stamps",
       .value = TextSetting{{}, member<&FlyOptions::start_utc>}},
      {.key = "mount_rpy_deg",
       .flag = "--mount",
       .help = "the sensor in the body's frame: roll,pitch,yaw in degrees; 0,90,0 lays the spin "
               "axis along the flight, azimuth 0 down",
       .value = VectorSetting{{-360, 360}, member<&FlyOptions::mount_rpy_deg>}},
      {.key = "pose_error",
       .flag = "--pose-error",
       .help = "errors of the reported poses, as of an RTK, PPK or GPS system "
               "(docs/pose-errors.md); the errors below are added to it",
       .value = TextSetting{flight::pose_error_presets(), member<&FlyOptions::pose_error>},
       .group = kPoseErrors},
      {.key = "position_noise_m",
       .flag = "--position-noise",
       .help = "standard deviation of each GNSS fix, east and north, metres, 0 to 100",
       .value = NumberSetting{{0, 100}, pose_error<&flight::PoseErrors::position_noise_m>},
       .group = kPoseErrors},
      {.key = "height_noise_m",
       .flag = "--height-noise",
       .help = "the same, up",
       .value = NumberSetting{{0, 100}, pose_error<&flight::PoseErrors::height_noise_m>},
       .group = kPoseErrors},
      {.key = "position_drift_m",
       .flag = "--position-drift",
       .help = "standard deviation of the slowly drifting error, east and north, metres, 0 to 100",
       .value = NumberSetting{{0, 100}, pose_error<&flight::PoseErrors::position_drift_m>},
       .group = kPoseErrors},
      {.key = "height_drift_m",
       .flag = "--height-drift",
       .help = "the same, up",
       .value = NumberSetting{{0, 100}, pose_error<&flight::PoseErrors::height_drift_m>},
       .group = kPoseErrors},
      {.key = "position_drift_s",
       .flag = "--position-drift-time",
       .help = "correlation time of these drifts, seconds, 0.1 to 100000",
       .value = NumberSetting{{0.1, 100000.0}, pose_error<&flight::PoseErrors::position_drift_s>},
       .group = kPoseErrors},
      {.key = "tilt_noise_deg",
       .flag = "--tilt-noise",
       .help = "standard deviation of each attitude, roll and pitch, degrees, 0 to 20",
       .value = NumberSetting{{0, 20}, pose_error<&flight::PoseErrors::tilt_noise_deg>},
       .group = kPoseErrors},
      {.key = "heading_noise_deg",
       .flag = "--heading-noise",
       .help = "the same, heading",
       .value = NumberSetting{{0, 20}, pose_error<&flight::PoseErrors::heading_noise_deg>},
       .group = kPoseErrors},
      {.key = "tilt_drift_deg",
       .flag = "--tilt-drift",
       .help = "standard deviation of the slowly drifting error, roll and pitch, degrees, 0 to 20",
       .value = NumberSetting{{0, 20}, pose_error<&flight::PoseErrors::tilt_drift_deg>},
       .group = kPoseErrors},
      {.key = "heading_drift_deg",
       .flag = "--heading-drift",
       .help = "the same, heading",
       .value = NumberSetting{{0, 20}, pose_error<&flight::PoseErrors::heading_drift_deg>},
       .group = kPoseErrors},
      {.key = "attitude_drift_s",
       .flag = "--attitude-drift-time",
       .help = "correlation time of these drifts, seconds, 0.1 to 100000",
       .value = NumberSetting{{0.1, 100000.0}, pose_error<&flight::PoseErrors::attitude_drift_s>},
       .group = kPoseErrors},
      {.key = "boresight_rpy_deg",
       .flag = "--boresight",
       .help = "how the sensor is truly turned from its mount, about the body's axes: "
               "roll,pitch,yaw in degrees, each -20 to 20",
       .value = VectorSetting{{-20, 20}, pose_error<&flight::PoseErrors::boresight_rpy_deg>},
       .group = kPoseErrors},
      {.key = "lever_arm_m",
       .flag = "--lever-arm",
       .help = "how far the sensor truly sits from its stated place: x,y,z in the body, metres, "
               "each -10 to 10",
       .value = VectorSetting{{-10, 10}, pose_error<&flight::PoseErrors::lever_arm_m>},
       .group = kPoseErrors},
      {.key = "clock_offset_s",
       .flag = "--clock-offset",
       .help = "the pose reported for a time is that of so many seconds later, -1 to 1",
       .value = NumberSetting{{-1, 1}, pose_error<&flight::PoseErrors::clock_offset_s>},
       .group = kPoseErrors},
  };
  return settings;
}

bool counts(const FlySetting& setting, const FlyOptions& options) {
  return !(options.flight && setting.plans != Plan::none) &&
         !(options.waypoints && setting.plans == Plan::strips);
}

nlohmann::json settings_json(const FlyOptions& options) {
  nlohmann::json document = nlohmann::json::object();
  for (const FlySetting& setting : fly_settings()) {
    if (!counts(setting, options)) continue;
    nlohmann::json value = std::visit(
        [&](const auto& of) { return setting_json(value_of(of, options)); }, setting.value);
    if (!value.is_null()) document[setting.key] = std::move(value);
  }
  return document;
}

void require_valid(const FlyOptions& options) {
  for (const FlySetting& setting : fly_settings()) {
    if (!counts(setting, options)) continue;
    std::visit([&](const auto& value) { plotscan::require_valid(setting.flag, value, options); },
               setting.value);
  }
}

}  // namespace plotscan::lidar
