// SPDX-License-Identifier: Apache-2.0
#include "flight/strips.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/csv.h"
#include "core/error.h"
#include "core/extent.h"

namespace plotscan::flight {
namespace {

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
  const Eigen::Rotation2Dd world_from_field(heading_rad);
  return {world_from_field, extent_of(areas, std::identity{}, world_from_field.inverse())};
}

double heading_of_strips(const std::vector<PlotBox>& areas, const StripOptions& options) {
  if (options.heading_rad) return *options.heading_rad;
  const double heading = mean_heading(areas);
  const Eigen::Vector2d sides = field_with_heading(areas, heading).bounds.sizes();
  return sides.x() >= sides.y() ? heading : heading + EIGEN_PI / 2;
}

double strips_needed(const Field& field, const StripOptions& options) {
  if (options.pattern == Pattern::single) return 1;
  // A turned field is wider by rounding: three spacings stay three strips.
  constexpr double kRounding = 1e-9;
  return std::max(1.0, std::ceil(field.bounds.sizes().y() / options.spacing_m - kRounding));
}

std::vector<Eigen::Vector3d> strips_along(const Field& field, double ground_m,
                                          const StripOptions& options) {
  const double strips = strips_needed(field, options);
  const double strip_m = field.bounds.sizes().x() + 2 * options.run_up_m;
  std::vector<Eigen::Vector3d> path;
  for (int strip = 0; strip < static_cast<int>(strips); ++strip) {
    const double across =
        field.bounds.center().y() + (strip - (strips - 1) / 2) * options.spacing_m;
    const double forth = strip % 2 == 0 ? 1 : -1;
    for (const double end : {-forth, forth}) {
      const Eigen::Vector2d place =
          field.world_from_field *
          Eigen::Vector2d(field.bounds.center().x() + end * strip_m / 2, across);
      path.emplace_back(place.x(), place.y(), ground_m + options.altitude_m);
    }
  }
  return path;
}

// Checked before strips are made, as there may be more of them than memory holds.
void require_length(const std::vector<Field>& fields, const StripOptions& options) {
  double length_m = 0;
  for (const Field& field : fields) {
    const double strip_m = field.bounds.sizes().x() + 2 * options.run_up_m;
    length_m += strips_needed(field, options) * (strip_m + options.spacing_m);
  }
  if (length_m <= kMaxPath_m) return;
  throw InputError("the flight would be longer than " + format_number(kMaxPath_m / 1000) +
                   " km; give a wider spacing");
}

}  // namespace

std::vector<Eigen::Vector3d> strips_over(const std::vector<PlotBox>& areas, double ground_m,
                                         const StripOptions& options) {
  check(!areas.empty(), "strips have something to cover");
  const double heading = heading_of_strips(areas, options);
  std::vector<Field> fields = {field_with_heading(areas, heading)};
  if (options.pattern == Pattern::crosshatch)
    fields.push_back(field_with_heading(areas, heading + EIGEN_PI / 2));
  require_length(fields, options);
  std::vector<Eigen::Vector3d> path = strips_along(fields.front(), ground_m, options);
  if (options.pattern == Pattern::crosshatch) {
    std::vector<Eigen::Vector3d> across = strips_along(fields.back(), ground_m, options);
    const Eigen::Vector3d& end = path.back();
    if ((across.back() - end).norm() < (across.front() - end).norm()) std::ranges::reverse(across);
    path.insert(path.end(), across.begin(), across.end());
  }
  return path;
}

}  // namespace plotscan::flight
