// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include <unistd.h>

#include "core/error.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

void require_free(const fs::path& path, bool replace) {
  if (!fs::exists(path)) return;
  if (!fs::is_directory(path)) throw InputError(path, "exists and is not a folder");
  if (fs::is_empty(path)) return;
  if (!fs::exists(path / "manifest.json")) {
    throw InputError(path, "exists and was not written by plotscan; choose another folder");
  }
  if (!replace) throw InputError(path, "exists; --force replaces it");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& final_path, bool replace)
    : final_(without_trailing_slash(final_path)) {
  require_free(final_, replace);
  temporary_ = final_.parent_path() /
               ("." + final_.filename().string() + ".partial-" + std::to_string(getpid()));
  std::error_code error;
  fs::remove_all(temporary_, error);
  fs::create_directories(temporary_, error);
  if (error) throw InputError(final_, "cannot be created: " + error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_, ignored);
}

void OutputFolder::commit() {
  fs::remove_all(final_);
  fs::rename(temporary_, final_);
  committed_ = true;
}

}  // namespace plotscan
