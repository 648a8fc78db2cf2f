// SPDX-License-Identifier: Apache-2.0
#include "scan/point_reader.h"

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "scan/fields.h"
#include "scan/internal/cloud_layout.h"
#include "scan/internal/las_format.h"
#include "scan/las_crs.h"

namespace plotscan::scan {
namespace {

constexpr double kOriginStep_m = 1000;
constexpr const char* kGpsTime = "gps_time";  // as read_las_header names it
// ASPRS' standard classes: 0 and 1 are unclassified, 2 ground, 3 to 5 vegetation.
PointClass class_of_asprs(double number) {
  if (number == 0 || number == 1) return PointClass::unlabelled;
  if (number == 2) return PointClass::ground;
  return number >= 3 && number <= 5 ? PointClass::crop : PointClass::other;
}

// Replaces the field "class" in files that do not have it.
const KnownField& asprs_class() {
  static const KnownField field = {
      .name = "class", .plain_names = {"classification"}, .put = [](LabelledPoint& p, double v) {
        p.label = class_of_asprs(v);
        return true;
      }};
  return field;
}

struct SelectedField {
  const KnownField* known;
  double unit;  // factor from the file's numbers to ours
};

// The fields to read: x, y, z, followed by the known ones that the file has.
struct Selection {
  std::vector<ScalarField> fields;
  std::vector<SelectedField> known;
};

double unit_of(const KnownField& known, const ScalarField& field) {
  return known.name == "time" ? time_unit_s(field) : 1;
}

Selection select(const CloudLayout& layout) {
  Selection selection;
  selection.fields = layout.coordinates();
  for (const KnownField& named : known_fields()) {
    const KnownField* known = &named;
    const ScalarField* field = find_field(layout, named.plain_names);
    if (field == nullptr && named.name == "class") {
      known = &asprs_class();
      field = find_field(layout, known->plain_names);
    }
    if (field == nullptr) continue;
    selection.fields.push_back(*field);
    selection.known.push_back({known, unit_of(*known, *field)});
  }
  return selection;
}

Eigen::Vector3d position(std::span<const double> row) { return {row[0], row[1], row[2]}; }

bool has_float_coordinates(const CloudLayout& layout) {
  return std::ranges::all_of(layout.coordinates(), [](const ScalarField& field) {
    return field.kind == 'F' && field.size == 4;
  });
}

// What to add to the file's times to get seconds from info.start.
double time_shift_s(const CloudLayout& layout, const CloudInfo& info) {
  return layout.adjusted_gps_time && info.start
             ? las::kGpsTimeAdjustment_s - gps_seconds(*info.start)
             : 0;
}

// A point's floats keep 1e-5 of a degree, which is a metre.
void require_lengths(const std::filesystem::path& cloud, const CloudLayout& layout) {
  if (!layout.in_degrees) return;
  throw InputError(cloud,
                   "has longitudes and latitudes, which would be rounded to a metre; project it "
                   "first, for instance to UTM (the estimator reads it as it is)");
}

// GeoTIFF keys become well-known text, so that no unit is lost.
std::string crs_wkt_of(const CloudLayout& layout) {
  if (!layout.crs_wkt.empty()) return layout.crs_wkt;
  if (layout.crs_epsg == 0 && layout.units == CoordinateUnits{}) return "";
  return coded_crs_wkt(layout.crs_epsg, layout.units);
}

}  // namespace

std::optional<UtcTime> utc_of_adjusted_gps(double adjusted_s) {
  const double gps_s = adjusted_s + las::kGpsTimeAdjustment_s;
  constexpr double kCentury_s = 3.2e9;
  if (!(gps_s >= 0 && gps_s < kCentury_s)) return std::nullopt;
  return utc_of_gps(gps_s);
}

std::optional<UtcTime> start_time_of(const std::filesystem::path& cloud,
                                     const CloudLayout& layout) {
  const ScalarField* time = layout.find(kGpsTime);
  if (layout.start || !layout.adjusted_gps_time || time == nullptr) return layout.start;
  std::vector<ScalarField> fields = layout.coordinates();
  fields.push_back(*time);
  const auto first = first_finite(cloud, layout, fields);
  return first ? utc_of_adjusted_gps(std::floor(first->back())) : std::nullopt;
}

Eigen::Vector3d origin_near(const Eigen::Vector3d& point_m) {
  return (point_m / kOriginStep_m).array().round() * kOriginStep_m;
}

CloudInfo read_cloud_info(const std::filesystem::path& cloud) {
  const CloudLayout layout = read_cloud_header(cloud);
  require_lengths(cloud, layout);
  const Selection selection = select(layout);
  CloudInfo info{.points = layout.is_text ? 0 : layout.points,
                 .start = start_time_of(cloud, layout),
                 .crs_wkt = crs_wkt_of(layout)};
  if (!has_float_coordinates(layout)) {
    const auto first = first_finite(cloud, layout, layout.coordinates());
    if (first) info.origin_m = origin_near(position(*first));
  }
  for (const SelectedField& field : selection.known) info.fields.push_back(field.known->name);
  return info;
}

CloudSummary read_points(const std::filesystem::path& cloud, const CloudInfo& info,
                         const PointSink& sink) {
  const CloudLayout layout = read_cloud_header(cloud);
  const Selection selection = select(layout);
  const double shift_s = time_shift_s(layout, info);
  CloudSummary summary;
  std::vector<LabelledPoint> points;
  const auto read = [&](std::span<const double> row) {
    const Eigen::Vector3f xyz = (position(row) - info.origin_m).cast<float>();
    if (!xyz.allFinite()) {  // nor what is too large for a float
      ++summary.not_finite;
      return;
    }
    LabelledPoint point{.x = xyz.x(), .y = xyz.y(), .z = xyz.z()};
    for (std::size_t i = 0; i < selection.known.size(); ++i) {
      const auto& [known, unit] = selection.known[i];
      if (known->put(point, row[3 + i] * unit)) continue;
      throw InputError(cloud, "point {}: \"{}\" is {}, which is no {}",
                       summary.points + summary.not_finite + 1, selection.fields[3 + i].name,
                       format_number(row[3 + i]), known->name);
    }
    point.time += shift_s;
    points.push_back(point);
    ++summary.points;
  };
  read_rows(cloud, layout, selection.fields, [&](std::span<const double> rows) {
    points.clear();
    for (std::size_t i = 0; i < rows.size(); i += selection.fields.size())
      read(rows.subspan(i, selection.fields.size()));
    if (!points.empty()) sink(points);
  });
  if (summary.points == 0) throw InputError(cloud, "no point of the cloud has finite x, y and z");
  return summary;
}

}  // namespace plotscan::scan
