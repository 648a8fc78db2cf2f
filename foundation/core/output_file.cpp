// SPDX-License-Identifier: Apache-2.0
#include "core/output_file.h"

#include <string>

#include <unistd.h>

#include "core/error.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

fs::path beside(const fs::path& path) {
  return path.parent_path() / ("." + path.stem().string() + ".partial-" + std::to_string(getpid()) +
                               path.extension().string());
}

}  // namespace

OutputFile::OutputFile(const fs::path& final_path, bool replace)
    : final_(fs::absolute(final_path)), temporary_(beside(final_)) {
  if (!final_path.has_filename()) throw InputError(final_path, "is no name of a file");
  std::error_code ignored;
  if (fs::is_directory(final_, ignored)) throw InputError(final_path, "is a folder");
  if (fs::exists(final_, ignored) && !replace)
    throw InputError(final_path, "exists; --force replaces it");
  if (!fs::is_directory(final_.parent_path(), ignored))
    throw InputError(final_path, "cannot be created: there is no such folder");
}

void OutputFile::commit() { fs::rename(path(), final_); }

}  // namespace plotscan
