// SPDX-License-Identifier: Apache-2.0
#include "farm/description_values.h"

namespace plotscan::farm {
namespace {

constexpr Range kUnit = {1e-6, 1e6};

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

}  // namespace plotscan::farm
