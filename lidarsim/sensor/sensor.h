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
  double azimuth_rad = 0;    // ahead of the head's azimuth: the beam leaves it askew
  double offset_m = 0;       // of the ray's origin along the spin axis
  double radius_m = 0;       // of the ray's origin from the spin axis, at the head's azimuth
  double fires_s = 0;        // after the firing sequence's start; several may fire at once
  std::uint16_t ring = 0;    // rank by elevation, 0 the lowest
};

// A laser's beam and what is made of its echoes (docs/beam.md). The beam is Gaussian about the
// shot's axis; an angle is the full one between the directions where its intensity is 1/e^2 of the
// axis', four standard deviations (ISO 11146).
struct Beam {
  double along_rad = 0;   // in the direction of the spin
  double across_rad = 0;  // across it
  double pulse_s = 0;     // the pulse's full width at half its maximum
  // Weaker echoes are not detected: a pulse from a facing Lambertian surface of this reflectance
  // that fills the beam at this range.
  double faintest_reflectance = 0;
  double faintest_range_m = 0;
  double least_separation_m = 0;  // of two returns of a shot; of closer ones the stronger counts
};

// How a sensor's raw data packets tell of it, for sensors that send Velodyne's (record/
// velodyne/packet.h): 16 or 32 lasers, whose order is that of the packets' laser ids.
struct PacketFormat {
  std::uint8_t product = 0;        // the packets' product byte
  double distance_step_m = 0.002;  // of their distances
};

// A wedge prism that turns about the x axis, one of a Risley scanner's two
// (sensor/risley.h).
struct Wedge {
  double slant_rad = 0;  // between its flat and its slanted side
  double refractive_index = 1;
  double turns_hz = 0;   // from y towards z; negative: from z towards y
  double phase_rad = 0;  // of its thick side at time 0, from y towards z
};

// A sensor that fires its lasers in sequence, over and over. It spins, and fires by the clock or so
// many times a turn; or it is a Risley scanner, which stands still and sends one laser through two
// turning prisms.
struct Sensor {
  std::string name;
  std::string title;  // "Velodyne VLP-16 (Puck)"
  // In the order of firing, at most kMaxLasers; of a Risley scanner its one laser's shots in a row.
  std::vector<Laser> lasers;
  std::optional<std::array<Wedge, 2>> wedges = {};  // of a Risley scanner, in the light's order
  double sequence_s = 0;     // from one firing sequence to the next; 0: by the spin
  int columns_per_turn = 0;  // firing sequences a turn where they follow the spin
  double min_range_m = 0;
  double max_range_m = 0;
  double range_step_m = 0;  // ranges are multiples of it; 0: not quantised
  double min_spin_hz = 0;   // 0 of what does not spin
  double max_spin_hz = 0;
  double default_spin_hz = 0;
  // How far the head's azimuth at each block of firings is off its steady spin (SpinJitter), where
  // a flight asks for that.
  double spin_jitter_rad = 0;
  std::optional<Beam> beam = {};             // where the file states one
  std::optional<PacketFormat> packets = {};  // none: it sends others
  std::string description;  // the text of the file that says all this, kept with a scan
};

inline constexpr std::size_t kMaxLasers = 128;

// Seconds from one firing sequence to the next.
double sequence_time_s(const Sensor& sensor, double spin_hz);

// Turns a second as asked for, or the sensor's own: 0 where it does not spin. Throws InputError
// when the sensor cannot.
double chosen_spin_hz(const Sensor& sensor, std::optional<double> asked_hz);

// The names of the sensors shipped (models/sensors).
const std::vector<std::string>& sensor_names();

// A shipped sensor by its name, or a user's by the path of its file, NAME.yaml (docs/sensors.md).
// Throws InputError: a missing file, or file:line, key and what is allowed.
Sensor load_sensor(const std::string& name_or_file);

// A sensor from its description; errors name it as `file`.
Sensor parse_sensor(const std::string& description, const std::filesystem::path& file);

}  // namespace plotscan::sensor
