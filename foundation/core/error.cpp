// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

#include <fstream>
#include <iterator>

namespace plotscan {

InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : InputError(file.string() + ": " + message) {}

InputError::InputError(const std::filesystem::path& file, std::size_t line,
                       const std::string& message)
    : InputError(file.string() + ":" + std::to_string(line) + ": " + message) {}

void check(bool condition, const std::string& what) {
  if (!condition) throw std::logic_error("internal error: " + what);
}

void require_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path, "no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError(path, "not a regular file");
  if (!std::ifstream(path, std::ios::binary)) throw InputError(path, "cannot be read");
}

std::string read_text(const std::filesystem::path& path) {
  require_file(path);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::filesystem::path path_inside(const std::filesystem::path& root,
                                  const std::filesystem::path& relative,
                                  const std::filesystem::path& source) {
  const std::filesystem::path normal = relative.lexically_normal();
  if (normal.empty() || normal.is_absolute() || *normal.begin() == "..") {
    throw InputError(source,
                     "path \"" + relative.string() + "\" leaves its folder " + root.string());
  }
  return root / normal;
}

}  // namespace plotscan
