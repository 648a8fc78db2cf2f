// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/plant_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "core/csv.h"
#include "core/number_text.h"
#include "core/text_file.h"
#include "farmfolder/internal/ordered_texts.h"

namespace plotscan::farmfolder {
namespace {

enum Column { id, plot, kind, model, x, y, z, qx, qy, qz, qw, scale_x, scale_y, scale_z, height };
const std::vector<std::string> kColumns = {"id",  "plot",    "kind",    "model",   "x_m",
                                           "y_m", "z_m",     "qx",      "qy",      "qz",
                                           "qw",  "scale_x", "scale_y", "scale_z", "height_m"};
// In the order of PlantKind.
constexpr std::array<std::string_view, 2> kKindNames = {"crop", "weed"};
// How far from 1 the length of a rotation's quaternion may be.
constexpr double kUnitTolerance = 1e-6;
constexpr double kMostScale = 1000;

using ModelIndex = std::unordered_map<std::string, std::uint32_t>;

farm::PlantKind kind_of(const CsvRow& row) {
  const auto name = std::find(kKindNames.begin(), kKindNames.end(), row.text(Column::kind));
  if (name == kKindNames.end()) row.fail(Column::kind, "is neither crop nor weed");
  return static_cast<farm::PlantKind>(name - kKindNames.begin());
}

farm::Plant plant_of(const CsvRow& row, std::size_t expected_id, const ModelIndex& models) {
  constexpr long long kMost = std::numeric_limits<std::uint32_t>::max();
  farm::Plant plant;
  plant.id = static_cast<std::uint32_t>(row.integer(Column::id, 1, kMost));
  if (plant.id != expected_id) row.fail(Column::id, "is not {}", expected_id);
  plant.plot = static_cast<std::uint32_t>(row.integer(Column::plot, 0, kMost));
  plant.kind = kind_of(row);
  const auto model = models.find(std::string(row.text(Column::model)));
  if (model == models.end()) row.fail(Column::model, "is not one of the farm's models");
  plant.model = model->second;
  plant.position = {row.number(Column::x), row.number(Column::y), row.number(Column::z)};
  plant.rotation.coeffs() = Eigen::Vector4d(row.number(Column::qx), row.number(Column::qy),
                                            row.number(Column::qz), row.number(Column::qw));
  if (std::abs(plant.rotation.norm() - 1) > kUnitTolerance)
    row.fail(Column::qw, "and qx, qy, qz are not a unit quaternion");
  for (int axis = 0; axis < 3; ++axis) {
    plant.scale[axis] = row.number(Column::scale_x + axis);
    if (plant.scale[axis] < 1 / kMostScale || plant.scale[axis] > kMostScale)
      row.fail(Column::scale_x + axis, "is not in [0.001, 1000]");
    if (std::abs(plant.position[axis]) > terrain::kFarthest_m)
      row.fail(Column::x + axis, "is more than 100 km from the farm's centre");
  }
  plant.height_m = row.number(Column::height);
  return plant;
}

void append_line(std::string& text, const farm::Plant& plant, std::string_view model) {
  text.append(NumberText(plant.id)).append(",").append(NumberText(plant.plot));
  text.append(",").append(kKindNames[static_cast<std::size_t>(plant.kind)]);
  text.append(",").append(model);
  for (const double value :
       {plant.position.x(), plant.position.y(), plant.position.z(), plant.rotation.x(),
        plant.rotation.y(), plant.rotation.z(), plant.rotation.w(), plant.scale.x(),
        plant.scale.y(), plant.scale.z(), plant.height_m})
    text.append(",").append(NumberText(value));
  text += '\n';
}

}  // namespace

void write_plants(const std::filesystem::path& path, const farm::Farm& farm, int threads) {
  constexpr std::size_t kPlantsOfText = 1000;
  TextFile out(path);
  for (std::size_t i = 0; i < kColumns.size(); ++i) out << (i == 0 ? "" : ",") << kColumns[i];
  out << "\n";
  const auto lines = [&](std::size_t number) {
    const std::span plants(farm.plants);
    const std::size_t begin = number * kPlantsOfText;
    std::string text;
    for (const farm::Plant& plant :
         plants.subspan(begin, std::min(kPlantsOfText, plants.size() - begin)))
      append_line(text, plant, farm.models[plant.model].name);
    return text;
  };
  make_in_order((farm.plants.size() + kPlantsOfText - 1) / kPlantsOfText, threads, lines,
                [&](std::size_t, const std::string& text) { out << text; });
  out.close();
}

std::vector<farm::Plant> read_plants(const std::filesystem::path& path,
                                     const std::vector<farm::PlantModel>& models) {
  ModelIndex index;
  for (std::uint32_t i = 0; i < models.size(); ++i) index[models[i].name] = i;
  std::vector<farm::Plant> plants;
  read_csv(path, kColumns, {},
           [&](const CsvRow& row) { plants.push_back(plant_of(row, plants.size() + 1, index)); });
  return plants;
}

}  // namespace plotscan::farmfolder
