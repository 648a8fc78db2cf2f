// SPDX-License-Identifier: Apache-2.0
#include "planting/layout_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/angle.h"
#include "core/csv.h"
#include "planting/plants_description.h"
#include "terrain/terrain.h"

namespace plotscan::planting {
namespace {

constexpr long long kGreatestId = std::numeric_limits<std::uint32_t>::max();

enum Column {
  model,
  x,
  y,
  id,
  z,
  scale,
  scale_x,
  scale_y,
  scale_z,
  yaw,
  pitch,
  roll,
  plot,
  kind,
  count
};
constexpr std::array<const char*, Column::count> kNames = {
    "model",   "x_m",     "y_m",     "id",        "z_m",      "scale", "scale_x",
    "scale_y", "scale_z", "yaw_deg", "pitch_deg", "roll_deg", "plot",  "kind"};
constexpr std::size_t kRequired = 3;

// Reads rows by Column, whatever the table's own names and order.
class LayoutRows {
 public:
  LayoutRows(const std::filesystem::path& file, const std::map<std::string, std::string>& renamed,
             const std::vector<std::string>& models)
      : file_(file) {
    for (std::size_t i = 0; i < models.size(); ++i) models_[models[i]] = i;
    for (std::size_t column = 0; column < Column::count; ++column) {
      const auto other = renamed.find(kNames[column]);
      const bool is_renamed = other != renamed.end();
      if (column >= kRequired && !is_renamed && is_taken(renamed, kNames[column])) continue;
      // A renamed column is wanted: a typing error in its name is to be found.
      auto& names = column < kRequired || is_renamed ? required_ : optional_;
      names.push_back(is_renamed ? other->second : kNames[column]);
      names_[column] = names.back();
    }
    for (std::size_t column = 0; column < Column::count; ++column) {
      if (names_[column].empty()) continue;
      const auto in_required = std::find(required_.begin(), required_.end(), names_[column]);
      places_[column] = in_required != required_.end()
                            ? in_required - required_.begin()
                            : static_cast<std::ptrdiff_t>(required_.size()) +
                                  (std::find(optional_.begin(), optional_.end(), names_[column]) -
                                   optional_.begin());
    }
  }

  std::vector<LayoutPlant> read() {
    std::vector<LayoutPlant> plants;
    read_csv(file_, required_, optional_, [&](const CsvRow& row) {
      plants.push_back(plant_of(row, static_cast<long long>(plants.size()) + 1));
    });
    return plants;
  }

 private:
  // Whether a table's column that happens to have one of our names is read as another of ours.
  static bool is_taken(const std::map<std::string, std::string>& renamed, const char* name) {
    return std::any_of(renamed.begin(), renamed.end(),
                       [&](const auto& entry) { return entry.second == name; });
  }

  bool has(const CsvRow& row, Column column) const {
    return !names_[column].empty() && !row.text(places_[column]).empty();
  }

  double number(const CsvRow& row, Column column, double fallback) const {
    return has(row, column) ? row.number(places_[column]) : fallback;
  }

  Eigen::Vector3d scale_of(const CsvRow& row) const {
    const double uniform = number(row, Column::scale, 1.0);
    Eigen::Vector3d scale;
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<Column>(Column::scale_x + axis);
      if (has(row, column) && has(row, Column::scale))
        row.fail(places_[column], "is given beside scale; give one of the two");
      scale[axis] = number(row, column, uniform);
      if (kPlantScale.contains(scale[axis])) continue;
      row.fail(places_[has(row, column) ? column : Column::scale], "is not in {}",
               kPlantScale.text());
    }
    return scale;
  }

  Eigen::Quaterniond rotation_of(const CsvRow& row) const {
    const auto turn = [&](Column column, const Eigen::Vector3d& axis) {
      return Eigen::AngleAxisd(number(row, column, 0.0) * kDegrees, axis);
    };
    return turn(Column::yaw, Eigen::Vector3d::UnitZ()) *
           turn(Column::pitch, Eigen::Vector3d::UnitY()) *
           turn(Column::roll, Eigen::Vector3d::UnitX());
  }

  std::uint32_t model_of(const CsvRow& row) const {
    const auto found = models_.find(std::string(row.text(places_[Column::model])));
    if (found == models_.end()) {
      std::string known;
      for (const auto& [name, index] : models_) known += (known.empty() ? "" : ", ") + name;
      row.fail(places_[Column::model], "is not one of the models {}", known);
    }
    return static_cast<std::uint32_t>(found->second);
  }

  farm::PlantKind kind_of(const CsvRow& row) const {
    if (!has(row, Column::kind)) return farm::PlantKind::crop;
    const std::string_view kind = row.text(places_[Column::kind]);
    if (kind == "crop") return farm::PlantKind::crop;
    if (kind == "weed") return farm::PlantKind::weed;
    row.fail(places_[Column::kind], "is neither crop nor weed");
  }

  LayoutPlant plant_of(const CsvRow& row, long long expected_id) const {
    if (has(row, Column::id) && row.integer(places_[Column::id], 1, kGreatestId) != expected_id) {
      row.fail(places_[Column::id], "is not {}: plants are numbered from 1 in the table's order",
               expected_id);
    }
    LayoutPlant plant;
    plant.model = model_of(row);
    plant.position = {row.number(places_[Column::x]), row.number(places_[Column::y])};
    if (has(row, Column::z)) plant.z_m = row.number(places_[Column::z]);
    if (std::abs(plant.z_m.value_or(0)) > terrain::kFarthest_m)
      row.fail(places_[Column::z], "is more than 100 km from the world's origin");
    plant.scale = scale_of(row);
    plant.rotation = rotation_of(row);
    if (has(row, Column::plot))
      plant.plot = static_cast<std::uint32_t>(row.integer(places_[Column::plot], 0, kGreatestId));
    plant.kind = kind_of(row);
    plant.line = row.line();
    return plant;
  }

  const std::filesystem::path& file_;
  std::map<std::string, std::size_t> models_;
  std::vector<std::string> required_;
  std::vector<std::string> optional_;
  std::array<std::string, Column::count> names_;  // the table's; empty: it has no such column
  std::array<std::ptrdiff_t, Column::count> places_{};
};

}  // namespace

std::vector<std::string> layout_columns() { return {kNames.begin(), kNames.end()}; }

std::vector<LayoutPlant> read_layout_table(const std::filesystem::path& file,
                                           const std::map<std::string, std::string>& column_names,
                                           const std::vector<std::string>& models) {
  return LayoutRows(file, column_names, models).read();
}

}  // namespace plotscan::planting
