// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include <cstdio>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"
#include "core/manifest.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

fs::path without_trailing_slash(const fs::path& path) {
  if (path.empty()) throw InputError("the output folder has no name");
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

fs::path beside(const fs::path& path, const std::string& what) {
  return path.parent_path() /
         ("." + path.filename().string() + "." + what + "-" + std::to_string(getpid()));
}

bool is_taken(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  if (!fs::is_directory(path, error)) throw InputError(path, "exists and is not a folder");
  const bool empty = fs::is_empty(path, error);
  if (error) throw InputError(path, "cannot be read: " + error.message());
  return !empty;
}

}  // namespace

void require_own_folder(const fs::path& folder, const std::string& command) {
  if (!is_taken(folder)) return;
  const auto manifest =
      fs::exists(folder / "manifest.json") ? read_manifest(folder) : nlohmann::json::object();
  const bool plotscan = manifest.contains("plotscan") && manifest.contains("command");
  if (!plotscan)
    throw InputError(folder, "exists and was not written by plotscan; choose another folder");
  if (manifest["command"] != command) {
    throw InputError(folder, "exists and was not written by " + command + " but by " +
                                 manifest["command"].dump() + "; choose another folder");
  }
}

OutputFolder::OutputFolder(const fs::path& final_path, bool replace, const std::string& command)
    : final_(without_trailing_slash(final_path)), temporary_(beside(final_, "partial")) {
  require_own_folder(final_, command);
  if (is_taken(final_) && !replace) throw InputError(final_path, "exists; --force replaces it");
  std::error_code error;
  fs::remove_all(path(), error);
  fs::create_directories(path(), error);
  if (error) throw InputError(final_path, "cannot be created: " + error.message());
}

void OutputFolder::commit() {
  // Where the file system can, old and new change places in one step: there is no moment without a
  // whole folder, and what goes with this object is the old one.
  if (renameat2(AT_FDCWD, path().c_str(), AT_FDCWD, final_.c_str(), RENAME_EXCHANGE) == 0) return;
  fs::remove_all(final_);
  fs::rename(path(), final_);
}

}  // namespace plotscan
