// SPDX-License-Identifier: Apache-2.0
#include "cloud/area.h"

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"

namespace plotscan::cloud {
namespace {

constexpr const char* kTooLong = " is longer than 10 km on a side";

bool is_too_long(const Area& area) { return sides_of(area).maxCoeff() > kLongestSide_m; }

}  // namespace

Area around(const Eigen::AlignedBox2d& rectangle, double margin_m) {
  return {rectangle.min().x() - margin_m, rectangle.min().y() - margin_m,
          rectangle.max().x() + margin_m, rectangle.max().y() + margin_m};
}

bool holds(const Area& area, const Eigen::Vector2d& place) {
  return place.x() >= area[0] && place.x() <= area[2] && place.y() >= area[1] &&
         place.y() <= area[3];
}

Eigen::Vector2d sides_of(const Area& area) { return {area[2] - area[0], area[3] - area[1]}; }

Eigen::Vector2d middle_of(const Area& area) {
  return {(area[0] + area[2]) / 2, (area[1] + area[3]) / 2};
}

std::string text_of(const Area& area) {
  const auto millimetres = [](double at) { return format_number(std::round(1000 * at) / 1000); };
  return joined(list_of(area, millimetres), ",");
}

void require_area(const Area& area, const std::string& option) {
  const bool finite = std::ranges::all_of(area, [](double value) { return std::isfinite(value); });
  if (!finite || area[0] >= area[2] || area[1] >= area[3]) {
    throw InputError(option + " " + text_of(area) +
                     " is no rectangle; it is x0,y0,x1,y1 with x0 < x1 and y0 < y1");
  }
  if (is_too_long(area)) throw InputError(option + " " + text_of(area) + kTooLong);
}

void require_scanned_area(const Area& area, const std::string& cloud) {
  const std::string field = cloud + ": the scanned field";
  if (is_too_long(area))
    throw InputError(
        field + " " + text_of(area) + kTooLong +
        "; give a part of it (--crop-box), or --units where coordinates are not metres");
  require_area(area, field);
}

}  // namespace plotscan::cloud
