// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_facts.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scan/field_names.h"
#include "scan/internal/cloud_layout.h"
#include "scan/internal/las_format.h"

namespace plotscan::scan {
namespace {

// A field besides x, y and z, and its index among the fields that are read.
struct Column {
  const ScalarField* field = nullptr;
  std::size_t place = 0;

  bool there() const { return field != nullptr; }
  double of(std::span<const double> row) const { return row[place]; }
};

// The fields to read: x, y and z first.
struct Columns {
  std::vector<ScalarField> fields;
  Column returned, classified, withheld, time;

  explicit Columns(const CloudLayout& layout) {
    for (const char* axis : {"x", "y", "z"}) fields.push_back(*layout.find(axis));
    const auto add = [&](Column& column, const std::vector<std::string>& names) {
      column = {find_field(layout, names), fields.size()};
      if (column.there()) fields.push_back(*column.field);
    };
    add(returned, {"returnnumber"});
    add(classified, {"classification"});
    if (layout.is_las) add(withheld, {std::string(las::kWithheld)});
    add(time, plain_names_of("time"));
  }
};

// NaN and negative numbers count as 0.
std::size_t bin_of(double number) {
  return number > 0 ? static_cast<std::size_t>(std::min(number, 255.0)) : 0;
}

bool is_noise(double number) { return number == las::kLowNoise || number == las::kHighNoise; }

// Collects facts from rows, one after the other.
class FactFinder {
 public:
  FactFinder(const CloudLayout& layout, const Columns& columns, CloudFacts& facts)
      : is_las_(layout.is_las), columns_(columns), facts_(facts) {
    if (columns.returned.there() && !facts.returns) facts.returns.emplace();
    if (columns.classified.there() && !facts.classes) facts.classes.emplace();
  }

  // The position in metres; not finite where the point is left out.
  Eigen::Vector3d take(std::span<const double> row) {
    const Eigen::Vector3d point(row[0], row[1], row[2]);
    Eigen::Vector3d point_m = facts_.system.metres_of(point);
    if (!point_m.allFinite()) {
      ++facts_.not_finite;
      return point_m;
    }
    ++facts_.points;
    facts_.bounds.extend(point);
    facts_.bounds_m.extend(point_m);
    if (columns_.returned.there()) ++(*facts_.returns)[bin_of(columns_.returned.of(row))];
    if (columns_.classified.there()) ++(*facts_.classes)[bin_of(columns_.classified.of(row))];
    if (is_las_ && (columns_.withheld.of(row) != 0 || is_noise(columns_.classified.of(row))))
      ++facts_.marked;
    if (columns_.time.there()) take_time(columns_.time.of(row) * time_unit_s(*columns_.time.field));
    return point_m;
  }

 private:
  void take_time(double time_s) {
    if (!std::isfinite(time_s)) return;
    if (!facts_.time_s) facts_.time_s = {time_s, time_s};
    auto& [first, last] = *facts_.time_s;
    first = std::min(first, time_s);
    last = std::max(last, time_s);
  }

  bool is_las_;
  const Columns& columns_;
  CloudFacts& facts_;
};

void date(const CloudLayout& layout, CloudFacts& facts) {
  if (!facts.time_s || !layout.adjusted_gps_time) return;
  const auto first = utc_of_adjusted_gps((*facts.time_s)[0]);
  const auto last = utc_of_adjusted_gps((*facts.time_s)[1]);
  if (first && last) facts.utc = {*first, *last};
}

void add_file(const std::filesystem::path& file, const PositionSink& sink, CloudFacts& facts) {
  const CloudLayout layout = read_cloud_header(file);
  if (facts.format.empty()) {
    facts.format = layout.format;
    for (const ScalarField& field : layout.fields) facts.fields.push_back(field.name);
  }
  const Columns columns(layout);
  FactFinder finder(layout, columns, facts);
  std::vector<Eigen::Vector3d> positions;
  read_rows(file, layout, columns.fields, [&](std::span<const double> rows) {
    positions.clear();
    for (std::size_t i = 0; i < rows.size(); i += columns.fields.size()) {
      const Eigen::Vector3d position = finder.take(rows.subspan(i, columns.fields.size()));
      if (position.allFinite()) positions.push_back(position);
    }
    if (!positions.empty()) sink(positions);
  });
  date(layout, facts);
}

}  // namespace

CloudFacts read_cloud_facts(const CloudFiles& cloud, const PositionSink& sink) {
  CloudFacts facts{.format = {}, .system = read_cloud_system(cloud)};
  for (const std::filesystem::path& file : cloud.files) add_file(file, sink, facts);
  if (facts.points == 0)
    throw InputError(cloud.name() + ": no point of the cloud has finite x, y and z");
  return facts;
}

}  // namespace plotscan::scan
