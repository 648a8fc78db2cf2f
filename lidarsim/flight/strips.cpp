// SPDX-License-Identifier: Apache-2.0
#include "flight/strips.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::flight {
namespace {

constexpr double kMaxPath_m = 100e3;

// The areas' direction: headings averaged as axes of four-fold symmetry, since the sides of a box
// are two directions and each is the same as its opposite.
double mean_heading(const std::vector<PlotBox>& areas) {
  double sine = 0;
  double cosine = 0;
  for (const PlotBox& area : areas) {
    sine += std::sin(4 * area.heading_rad);
    cosine += std::cos(4 * area.heading_rad);
  }
  return std::atan2(sine, cosine) / 4;
}

// The areas' bounding rectangle in axes along and across the strips.
struct Field {
  Eigen::Rotation2Dd world_from_field{0};
  Eigen::AlignedBox2d bounds;
};

Field field_with_heading(const std::vector<PlotBox>& areas, double heading_rad) {
  Field field{.world_from_field = Eigen::Rotation2Dd(heading_rad), .bounds = {}};
  for (const PlotBox& area : areas) {
    for (const Eigen::Vector2d& corner : area.corners())
      field.bounds.extend(field.world_from_field.inverse() * corner);
  }
  return field;
}

Field field_along_longer_side(const std::vector<PlotBox>& areas) {
  const double heading = mean_heading(areas);
  const Field field = field_with_heading(areas, heading);
  const Eigen::Vector2d sides = field.bounds.sizes();
  return sides.x() >= sides.y() ? field : field_with_heading(areas, heading + EIGEN_PI / 2);
}

}  // namespace

std::vector<Eigen::Vector3d> strips_over(const std::vector<PlotBox>& areas,
                                         const StripOptions& options) {
  check(!areas.empty(), "strips have something to cover");
  const Field field = field_along_longer_side(areas);
  const Eigen::Vector2d sides = field.bounds.sizes();
  const double strips = std::max(1.0, std::ceil(sides.y() / options.spacing_m));
  const double strip_m = sides.x() + 2 * options.run_up_m;
  if (strips * (strip_m + options.spacing_m) > kMaxPath_m) {
    throw InputError("the flight would be longer than " + format_number(kMaxPath_m / 1000) +
                     " km; give a wider spacing");
  }
  std::vector<Eigen::Vector3d> path;
  for (int strip = 0; strip < static_cast<int>(strips); ++strip) {
    const double across =
        field.bounds.center().y() + (strip - (strips - 1) / 2) * options.spacing_m;
    const double forth = strip % 2 == 0 ? 1 : -1;
    for (const double end : {-forth, forth}) {
      const Eigen::Vector2d place =
          field.world_from_field *
          Eigen::Vector2d(field.bounds.center().x() + end * strip_m / 2, across);
      path.emplace_back(place.x(), place.y(), options.height_m);
    }
  }
  return path;
}

}  // namespace plotscan::flight
