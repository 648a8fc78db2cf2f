// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plotscan::sensor {

// One laser of a spinning sensor. Lidar frame as in the ROS velodyne driver: x forward at azimuth
// 0, y left, z the spin axis; azimuth grows clockwise seen from +z.
struct Laser {
  double elevation_rad = 0;  // over the x-y plane
  double azimuth_rad = 0;    // added to the head's azimuth: the beam leaves it askew
  double offset_m = 0;       // of the ray's origin along the spin axis
  double radius_m = 0;       // of the ray's origin from the spin axis, at the head's azimuth
  double fires_s = 0;        // after the firing sequence's start; several may fire at once
  std::uint16_t ring = 0;    // rank by elevation, 0 the lowest
};

// A laser's beam and how its echoes are detected (docs/beam.md). The beam is Gaussian about the
// shot's axis. Its angles are full angles between the directions where the intensity is 1/e^2 of
// that on the axis, which is four standard deviations (ISO 11146).
struct Beam {
  double along_rad = 0;   // in the direction of the spin
  double across_rad = 0;  // across it
  double pulse_s = 0;     // the pulse's full width at half its maximum
  // The detection threshold: the echo of a Lambertian surface of this reflectance that faces the
  // sensor and fills the beam at this range. Weaker echoes are not detected.
  double faintest_reflectance = 0;
  double faintest_range_m = 0;
  double least_separation_m = 0;  // of two returns of a shot; of closer ones the stronger is kept
};

// The sensor's entries in its raw data packets, for sensors that send Velodyne's packets
// (record/velodyne/packet.h). They have 16 or 32 lasers, in the order of the packets' laser ids.
struct PacketFormat {
  std::uint8_t product = 0;        // the packets' product byte
  double distance_step_m = 0.002;  // one step of their distances
};

// A wedge prism that turns about the x axis, one of a Risley scanner's two
// (sensor/risley.h).
struct Wedge {
  double slant_rad = 0;  // between its flat and its slanted side
  double refractive_index = 1;
  double turns_hz = 0;   // from y towards z; negative: from z towards y
  double phase_rad = 0;  // of its thick side at time 0, from y towards z
};

// A sensor that fires its lasers in sequence, again and again. Either it spins, and fires by the
// clock or a fixed number of times a turn; or it is a Risley scanner, which stands still and sends
// one laser through two turning prisms.
struct Sensor {
  std::string name;
  std::string title;  // "Velodyne VLP-16 (Puck)"
  // In the order of firing, at most kMaxLasers. For a Risley scanner: successive shots of its one
  // laser.
  std::vector<Laser> lasers;
  std::optional<std::array<Wedge, 2>> wedges = {};  // of a Risley scanner, in the light's order
  double sequence_s = 0;     // time between firing sequences; 0: set by the spin
  int columns_per_turn = 0;  // firing sequences a turn, if they follow the spin
  double min_range_m = 0;
  double max_range_m = 0;
  double range_step_m = 0;  // ranges are multiples of it; 0: not quantised
  double min_spin_hz = 0;   // 0 if the sensor does not spin
  double max_spin_hz = 0;
  double default_spin_hz = 0;
  // Standard deviation of the head's azimuth about a steady spin, at each block of firings
  // (SpinJitter); applied only if a flight asks for it.
  double spin_jitter_rad = 0;
  std::optional<Beam> beam = {};             // if the file states one
  std::optional<PacketFormat> packets = {};  // absent: it sends other packets
  std::string description;                   // the text of the sensor's file, kept with a scan
};

inline constexpr std::size_t kMaxLasers = 128;

// Seconds from one firing sequence to the next.
double sequence_time_s(const Sensor& sensor, double spin_hz);

// The requested turns a second, or else the sensor's default; 0 if it does not spin. Throws
// InputError when the sensor cannot spin so.
double chosen_spin_hz(const Sensor& sensor, std::optional<double> asked_hz);

// The names of the sensors shipped (models/sensors).
const std::vector<std::string>& sensor_names();

// A shipped sensor by its name, or a user's by the path of its file, NAME.yaml (docs/sensors.md).
// Throws InputError on a missing file, or with file:line, the key and what is allowed.
Sensor load_sensor(const std::string& name_or_file);

// A sensor from its description; errors name it as `file`.
Sensor parse_sensor(const std::string& description, const std::filesystem::path& file);

}  // namespace plotscan::sensor
