// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_facts.h"

#include <cmath>

#include "core/error.h"
#include "scan/fields.h"
#include "scan/internal/cloud_layout.h"
#include "scan/internal/las_format.h"

namespace plotscan::scan {
namespace {

// NaN and negative numbers count as 0.
std::size_t bin_of(double number) {
  return number > 0 ? static_cast<std::size_t>(std::min(number, 255.0)) : 0;
}

bool is_noise(double number) { return number == las::kLowNoise || number == las::kHighNoise; }

// Collects facts from the rows of one file. Knows which fields are to be read: x, y and z first.
class FactFinder {
 public:
  FactFinder(const CloudLayout& layout, CloudFacts& facts)
      : fields_(layout.coordinates()), facts_(facts) {
    returned_ = add(find_field(layout, {"returnnumber"}));
    classified_ = add(find_field(layout, {"classification"}));
    if (layout.is_las) withheld_ = add(layout.find(las::kWithheld));
    time_ = add(find_field(layout, known_field("time").plain_names));
    if (returned_ && !facts.returns) facts.returns.emplace();
    if (classified_ && !facts.classes) facts.classes.emplace();
  }

  const std::vector<ScalarField>& fields() const { return fields_; }

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
    if (returned_) ++(*facts_.returns)[bin_of(row[*returned_])];
    if (classified_) ++(*facts_.classes)[bin_of(row[*classified_])];
    if (withheld_ && (row[*withheld_] != 0 || is_noise(row[*classified_]))) ++facts_.marked;
    if (time_) take_time(row[*time_] * time_unit_s(fields_[*time_]));
    return point_m;
  }

 private:
  // Where the field lies in a row, if the file has it.
  using Place = std::optional<std::size_t>;
  Place add(const ScalarField* field) {
    if (field == nullptr) return std::nullopt;
    fields_.push_back(*field);
    return fields_.size() - 1;
  }

  void take_time(double time_s) {
    if (std::isfinite(time_s)) extend(facts_.time_s, time_s);
  }

  std::vector<ScalarField> fields_;
  Place returned_, classified_, withheld_, time_;
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
  FactFinder finder(layout, facts);
  const std::vector<ScalarField>& fields = finder.fields();
  std::vector<Eigen::Vector3d> positions;
  read_rows(file, layout, fields, [&](std::span<const double> rows) {
    positions.clear();
    for (std::size_t i = 0; i < rows.size(); i += fields.size()) {
      const Eigen::Vector3d position = finder.take(rows.subspan(i, fields.size()));
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
