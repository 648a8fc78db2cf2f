// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/grass.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "crop/internal/axis.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kHalfTurn = kPi;
constexpr double kTipExponent = 0.8;  // of the cosine that narrows a blade to its tip

}  // namespace

double grass_width_share(double share, double base_width_share, double widest_at) {
  if (share < widest_at) {
    const double risen = std::sin(kHalfTurn / 2 * share / widest_at);
    return base_width_share + (1 - base_width_share) * risen;
  }
  const double left = std::cos(kHalfTurn / 2 * (share - widest_at) / (1 - widest_at));
  return share < 1 ? std::pow(std::max(left, 0.0), kTipExponent) : 0;
}

Blade grass_blade(const GrassBlade& blade) {
  Blade sheet{.midrib = {},
              .half_width_m = {},
              .across = {},
              .fold_rad = blade.fold_rad,
              .light_points = blade.light_points};
  const double step = blade.length_m * blade.visible / (blade.points - 1);
  const Vector3d level = direction(blade.azimuth_rad + kHalfTurn / 2, 0);
  Vector3d point = blade.collar;
  for (int i = 0; i < blade.points; ++i) {
    const double share = static_cast<double>(i) / (blade.points - 1);
    const double half =
        blade.width_m / 2 *
        grass_width_share(1 - blade.visible * (1 - share), blade.base_width_share, blade.widest_at);
    // The direction halfway to the next point.
    const double halfway = i == 0 ? 0 : share - 0.5 / (blade.points - 1);
    const double elevation =
        blade.elevation_rad - blade.bend_rad * std::pow(halfway, blade.bend_exponent);
    Vector3d along = direction(blade.azimuth_rad, elevation);
    const bool lies = point.z() + step * along.z() < half && along.z() < 0;
    if (lies) along = direction(blade.azimuth_rad, 0);
    if (i > 0) point += step * along;
    const double roll =
        blade.twist_rad * share +
        blade.undulation_rad *
            std::sin(2 * kHalfTurn * blade.undulation_waves * share + blade.undulation_phase);
    sheet.midrib.push_back(point);
    sheet.half_width_m.push_back(half);
    sheet.across.push_back(lies ? level : Eigen::AngleAxisd(roll, along) * level);
  }
  return sheet;
}

double RankProfile::at(double rank) const {
  if (rank <= peak_rank) {
    if (peak_rank <= first_rank) return 1;
    const double share = std::clamp((rank - first_rank) / (peak_rank - first_rank), 0.0, 1.0);
    return first + (1 - first) * std::pow(std::sin(kHalfTurn / 2 * share), rise_exponent);
  }
  const double share = std::clamp((last_rank - rank) / (last_rank - peak_rank), 0.0, 1.0);
  return last + (1 - last) * std::sin(kHalfTurn / 2 * share);
}

}  // namespace plotscan::crop
