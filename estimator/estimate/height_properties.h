// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/angle.h"
#include "estimate/estimate.h"

namespace plotscan::estimate {

// What heights are called in files.
inline constexpr std::string_view kPrefix = "height_";
inline constexpr std::string_view kError = "se_";
inline constexpr std::string_view kLow = "low95_";
inline constexpr std::string_view kHigh = "high95_";
inline constexpr std::string_view kCanopy = "canopy_";
inline constexpr std::string_view kSuffix = "_m";

// A number of HeightError, and what stands before the height's property in its own.
struct ErrorProperty {
  std::string_view before;
  double HeightError::*value;
};
inline constexpr std::array<ErrorProperty, 3> kErrorProperties = {
    {{kError, &HeightError::standard_error_m},
     {kLow, &HeightError::low95_m},
     {kHigh, &HeightError::high95_m}}};

// The standard errors of a box (PlotBoxError), in its order.
inline constexpr std::array<const char*, 5> kBoxErrors = {
    "se_center_along_m", "se_center_across_m", "se_width_m", "se_length_m", "se_heading_deg"};
inline std::array<double, 5> numbers_of(const PlotBoxError& error) {
  return {error.along_m, error.across_m, error.width_m, error.length_m,
          error.heading_rad / kDegrees};
}

// Whether a height can be one in metres: those of crops can, marks of missing values (-9999)
// cannot.
inline constexpr double kLeastHeight_m = -100;
inline constexpr double kMostHeight_m = 1000;
inline bool is_plausible(double height_m) {
  return height_m >= kLeastHeight_m && height_m <= kMostHeight_m;
}

// The property of a height, and of what belongs to it ("se_", "low95_", "high95_"): the truth's own
// names, height_p95_m and canopy_p95_m.
inline std::string property_of(const std::string& height, std::string_view before = "") {
  const std::string prefix = height.starts_with(kCanopy) ? "" : std::string(kPrefix);
  return std::string(before) + prefix + height + std::string(kSuffix);
}

// The name of a height from its property, "" when the property is no height.
inline std::string height_of(const std::string& property) {
  if (!property.ends_with(kSuffix)) return "";
  std::string name = property.substr(0, property.size() - kSuffix.size());
  if (name.size() > kCanopy.size() && name.starts_with(kCanopy)) return name;
  if (name.size() <= kPrefix.size() || !name.starts_with(kPrefix)) return "";
  return name.substr(kPrefix.size());
}

}  // namespace plotscan::estimate
