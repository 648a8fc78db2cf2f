// SPDX-License-Identifier: Apache-2.0
#include "description/internal/shared_keys.h"

#include <string_view>

#include "mesh/obj.h"
#include "planting/plants_description.h"

namespace plotscan::description {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr std::string_view kAlsoInNames = "-.";

}  // namespace

std::filesystem::path file_at(const YamlSection& section, const std::string& key) {
  const std::string text = section.text(key);
  std::filesystem::path path = section.file().parent_path() / text;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    section.fail(key, "\"{}\" is no file (looked for {})", text, path.string());
  return path;
}

mesh::MeshImportOptions read_mesh_options(const YamlSection& section) {
  mesh::MeshImportOptions options;
  if (section.has("up"))
    options.up = section.choice("up", {"z", "y"}) == 0 ? mesh::UpAxis::z : mesh::UpAxis::y;
  options.unit_m = section.number("unit_m", {1e-6, 1e6}, options.unit_m);
  return options;
}

std::string name_at(const YamlSection& section, const std::string& key,
                    std::optional<std::string> fallback) {
  if (fallback) fallback = mesh::plain_name(*fallback, kAlsoInNames);
  std::string name = section.text(key, fallback);
  if (name.size() > kLongestName || name.front() == '.' ||
      name != mesh::plain_name(name, kAlsoInNames)) {
    section.fail(
        key, "\"{}\" is not a name: 1 to 64 letters, digits, '-', '_', '.', not beginning with '.'",
        name);
  }
  return name;
}

double reflectance_at(const YamlSection& section, const std::string& key) {
  return section.number(key, {0, 1});
}

std::pair<double, double> scale_at(const YamlSection& section) {
  const auto scale = section.pair("scale", planting::kPlantScale, std::pair{1.0, 1.0});
  if (scale.first > scale.second) section.fail("scale", "is not [min, max]: min is the larger");
  return scale;
}

}  // namespace plotscan::description
