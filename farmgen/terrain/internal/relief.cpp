// SPDX-License-Identifier: Apache-2.0
#include "terrain/internal/relief.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"

namespace plotscan::terrain {
namespace {

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

double across_furrows(const FurrowsDescription& furrows, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = direction(furrows.heading_rad);
  return point.dot(Eigen::Vector2d(-along.y(), along.x())) - furrows.offset_m;
}

}  // namespace

double furrow_height(const FurrowsDescription& furrows, double across_m) {
  const double phase = std::remainder(across_m / furrows.spacing_m, 1.0);  // in [-0.5, 0.5]
  if (furrows.profile == FurrowProfile::sine)
    return furrows.depth_m / 2 * std::cos(2 * kPi * phase);
  return furrows.depth_m / 2 * std::clamp(8 * (0.25 - std::abs(phase)), -1.0, 1.0);
}

Relief::Relief(const TerrainDescription& description, const Eigen::AlignedBox2d& detail,
               double fade_m, std::uint64_t seed)
    : slope_(description.slope), furrows_(description.furrows), detail_(detail), fade_m_(fade_m) {
  if (description.rolling) rolling_ = rolling_waves(*description.rolling, seed);
  if (description.clods) clods_ = clod_waves(*description.clods, seed);
}

double Relief::slope_height(const Eigen::Vector2d& point) const {
  return slope_ ? slope_->gradient * point.dot(direction(slope_->direction_rad)) : 0.0;
}

// A smooth step from 0 at the border to 1 inside.
double Relief::share_of_detail(const Eigen::Vector2d& point) const {
  const double inside_m = (point - detail_.min()).cwiseMin(detail_.max() - point).minCoeff();
  const double share = std::clamp(inside_m / fade_m_, 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

double Relief::furrows_height(const Eigen::Vector2d& point) const {
  return furrows_ ? furrow_height(*furrows_, across_furrows(*furrows_, point)) : 0.0;
}

double Relief::height(const Eigen::Vector2d& point) const {
  const double detail_m = furrows_height(point) + wave_height(clods_, point);
  return slope_height(point) + wave_height(rolling_, point) + share_of_detail(point) * detail_m;
}

Eigen::MatrixXd Relief::heights(const Lattice& lattice) const {
  Eigen::MatrixXd heights_m = wave_heights(rolling_, lattice);
  const Eigen::MatrixXd clods_m = wave_heights(clods_, lattice);
  for (Eigen::Index column = 0; column < lattice.columns; ++column) {
    for (Eigen::Index row = 0; row < lattice.rows; ++row) {
      const Eigen::Vector2d point = lattice.point(row, column);
      heights_m(row, column) +=
          slope_height(point) +
          share_of_detail(point) * (furrows_height(point) + clods_m(row, column));
    }
  }
  return heights_m;
}

}  // namespace plotscan::terrain
