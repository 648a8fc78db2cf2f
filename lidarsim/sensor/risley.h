// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// One number per laser, in the order of firing. Vectors are stored by component, so that several
// lasers are computed at once.
using PerLaser = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLasers, 1>;
using VectorPerLaser = std::array<PerLaser, 3>;

// The directions of a laser beam along x after two wedge prisms that turn about x, refracted by
// Snell's law at each surface; after Brazeal, Wilkinson and Hochmair, "A Rigorous Observation Model
// for the Risley Prism-Based Livox Mid-40 Lidar Sensor", Sensors 21 (2021) 4722, equations 3 to 10.
// The prisms' flat sides face outwards and are perpendicular to x; their slanted sides face each
// other. Adding the deflections of two thin prisms instead would be 4 % too small at the rim of the
// Mid-40's field of view.
class Risley {
 public:
  // Shot k of a sequence is fired fires_s[k] after the sequence's start.
  Risley(const std::array<Wedge, 2>& wedges, const PerLaser& fires_s);

  // Unit vectors in the lidar frame for `count` shots, from shot `begin` on, of the sequence that
  // starts at time_s.
  VectorPerLaser directions(double time_s, Eigen::Index begin, Eigen::Index count) const;

 private:
  struct Turning {
    double turns_hz = 0;
    double phase_rad = 0;
    PerLaser cos_advance;  // of the prism's turn until shot k
    PerLaser sin_advance;
  };
  static std::array<PerLaser, 2> thick_side(const Turning& wedge, double time_s, Eigen::Index begin,
                                            Eigen::Index count);

  std::array<Turning, 2> turning_;
  // After the first prism the beam is (along_, bend_ * thick side), whatever its angle.
  double along_ = 0;
  double bend_ = 0;
  double cos_slant_ = 0;  // of the second prism
  double sin_slant_ = 0;
  double index_ = 0;
};

// The greatest and the least angle between the beam and the x axis, radians; NaN if a prism totally
// reflects the beam.
std::array<double, 2> deflections_rad(const std::array<Wedge, 2>& wedges);

}  // namespace plotscan::sensor
