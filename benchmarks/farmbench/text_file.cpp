// SPDX-License-Identifier: Apache-2.0
#include "farmbench/text_file.h"

#include <fstream>

#include <unistd.h>

#include "core/error.h"

namespace plotscan::farmbench {

void write_text(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path partial =
      path.parent_path() /
      ("." + path.filename().string() + ".partial-" + std::to_string(getpid()));
  std::ofstream out(partial, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw InputError(path, "cannot be written");
  }
  std::filesystem::rename(partial, path);
}

}  // namespace plotscan::farmbench
