// SPDX-License-Identifier: Apache-2.0
#include "sensor/risley.h"

#include <cmath>

#include "core/angle.h"

namespace plotscan::sensor {

Risley::Risley(const std::array<Wedge, 2>& wedges, const PerLaser& fires_s) {
  for (std::size_t i = 0; i < 2; ++i) {
    const PerLaser advance_rad = 2 * kPi * wedges[i].turns_hz * fires_s;
    turning_[i] = {.turns_hz = wedges[i].turns_hz,
                   .phase_rad = wedges[i].phase_rad,
                   .cos_advance = advance_rad.cos(),
                   .sin_advance = advance_rad.sin()};
  }
  // The beam meets the first prism's flat side squarely and leaves through its slanted side, whose
  // normal is (cos, -sin * thick side): v = index * x + change * normal.
  const double first = wedges[0].refractive_index;
  const double cosine = std::cos(wedges[0].slant_rad);
  const double sine = std::sin(wedges[0].slant_rad);
  const double change = std::sqrt(1 - first * first * sine * sine) - first * cosine;
  along_ = first + change * cosine;
  bend_ = -change * sine;
  cos_slant_ = std::cos(wedges[1].slant_rad);
  sin_slant_ = std::sin(wedges[1].slant_rad);
  index_ = wedges[1].refractive_index;
}

// Cosine and sine of the angle, from y towards z, of the prism's thick side.
std::array<PerLaser, 2> Risley::thick_side(const Turning& wedge, double time_s, Eigen::Index begin,
                                           Eigen::Index count) {
  const double turns = wedge.turns_hz * time_s;
  const double angle_rad = 2 * kPi * (turns - std::floor(turns)) + wedge.phase_rad;
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  const auto cos_advance = wedge.cos_advance.segment(begin, count);
  const auto sin_advance = wedge.sin_advance.segment(begin, count);
  return {cosine * cos_advance - sine * sin_advance, sine * cos_advance + cosine * sin_advance};
}

VectorPerLaser Risley::directions(double time_s, Eigen::Index begin, Eigen::Index count) const {
  const auto first = thick_side(turning_[0], time_s, begin, count);
  const auto second = thick_side(turning_[1], time_s, begin, count);
  // Into the second prism's slanted side, whose normal is (cos, sin * thick side).
  const double ratio = 1 / index_;
  const PerLaser incidence =
      along_ * cos_slant_ + bend_ * sin_slant_ * (first[0] * second[0] + first[1] * second[1]);
  const PerLaser change = (1 - ratio * ratio * (1 - incidence.square())).sqrt() - ratio * incidence;
  // Out of its flat side: components across x are multiplied by the index.
  const PerLaser y = index_ * (ratio * bend_ * first[0] + sin_slant_ * change * second[0]);
  const PerLaser z = index_ * (ratio * bend_ * first[1] + sin_slant_ * change * second[1]);
  return {(1 - y.square() - z.square()).sqrt(), y, z};
}

std::array<double, 2> deflections_rad(const std::array<Wedge, 2>& wedges) {
  // With both thick sides at the same angle the beam is bent most, with opposite ones least.
  std::array<Wedge, 2> still = wedges;
  for (Wedge& wedge : still) wedge.turns_hz = 0;
  std::array<double, 2> deflection_rad = {};
  for (const int opposite : {0, 1}) {
    still[0].phase_rad = 0;
    still[1].phase_rad = opposite * kPi;
    const VectorPerLaser direction = Risley(still, PerLaser::Zero(1)).directions(0, 0, 1);
    deflection_rad[opposite] =
        std::atan2(std::hypot(direction[1][0], direction[2][0]), direction[0][0]);
  }
  return deflection_rad;
}

}  // namespace plotscan::sensor
