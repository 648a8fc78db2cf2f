// SPDX-License-Identifier: Apache-2.0
#include "mesh/internal/mtl_comments.h"

#include <fstream>

#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan::mesh {
namespace {

// What stands behind the key, without blanks around it; absent where the line begins otherwise.
std::optional<std::string> behind(const std::string& line, const std::string& key) {
  if (!line.starts_with(key)) return {};
  const std::string_view rest = std::string_view(line).substr(key.size());
  const std::string_view text = without_blanks(rest);
  if (text.empty() || text.data() == rest.data()) return {};  // or a longer word
  return std::string(text);
}

// A number in [0, 1] behind the key; absent where the line begins otherwise.
std::optional<float> share(const std::string& line, const char* key,
                           const std::filesystem::path& file, std::size_t number) {
  const auto text = behind(line, key);
  if (!text) return {};
  const auto value = parsed<float>(*text);
  if (value && *value >= 0 && *value <= 1) return value;
  throw InputError(file, number, "{}: \"{}\" is not a number in [0, 1]", key, *text);
}

void read_library(const std::filesystem::path& file, std::map<std::string, MtlComments>& found) {
  std::ifstream in(file);
  std::string material;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (const auto name = behind(line, "newmtl")) material = *name;
    if (const auto value = share(line, kReflectanceComment, file, number))
      found[material].reflectance = value;
    if (const auto value = share(line, kCutoffComment, file, number))
      found[material].cutoff = value;
  }
}

}  // namespace

std::map<std::string, MtlComments> read_mtl_comments(const std::filesystem::path& obj) {
  std::map<std::string, MtlComments> found;
  if (lower_extension(obj) != ".obj") return found;
  std::ifstream in(obj);
  for (std::string line; std::getline(in, line);) {
    // Libraries are named before the first vertex: the rest of the file need not be read again.
    if (line.starts_with("v ")) break;
    if (const auto library = behind(line, "mtllib")) {
      std::error_code error;
      const std::filesystem::path file = obj.parent_path() / *library;
      if (std::filesystem::is_regular_file(file, error)) read_library(file, found);
    }
  }
  return found;
}

}  // namespace plotscan::mesh
