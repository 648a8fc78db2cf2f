// SPDX-License-Identifier: Apache-2.0
#include "description/internal/values.h"

#include <string_view>

#include "planting/plants_description.h"

namespace plotscan::description {
namespace {

constexpr Range kUnit = {1e-6, 1e6};
constexpr Range kReflectance = {0, 1};
constexpr std::size_t kLongestName = 64;
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";

}  // namespace

std::filesystem::path file_at(const YamlSection& section, const std::string& key) {
  const std::string text = section.text(key);
  std::filesystem::path path = section.file().parent_path() / text;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    section.fail(key, "\"" + text + "\" is no file (looked for " + path.string() + ")");
  }
  return path;
}

mesh::MeshImportOptions read_mesh_options(const YamlSection& section) {
  mesh::MeshImportOptions options;
  if (section.has("up"))
    options.up = section.choice("up", {"z", "y"}) == 0 ? mesh::UpAxis::z : mesh::UpAxis::y;
  options.unit_m = section.number("unit_m", kUnit, options.unit_m);
  return options;
}

std::string name_at(const YamlSection& section, const std::string& key,
                    std::optional<std::string> fallback) {
  if (fallback) {
    for (char& c : *fallback) {
      if (kNameCharacters.find(c) == std::string_view::npos) c = '_';
    }
  }
  std::string name = section.text(key, fallback);
  if (name.size() > kLongestName || name.front() == '.' ||
      name.find_first_not_of(kNameCharacters) != std::string::npos) {
    section.fail(key, "\"" + name +
                          "\" is not a name: 1 to 64 letters, digits, '-', '_', '.', not beginning "
                          "with '.'");
  }
  return name;
}

double reflectance_at(const YamlSection& section, const std::string& key) {
  return section.number(key, kReflectance);
}

std::pair<double, double> scale_at(const YamlSection& section) {
  const auto scale = section.pair("scale", planting::kPlantScale, std::pair{1.0, 1.0});
  if (scale.first > scale.second) section.fail("scale", "is not [min, max]: min is the larger");
  return scale;
}

}  // namespace plotscan::description
