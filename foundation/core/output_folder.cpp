// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <fcntl.h>

#include "core/error.h"
#include "core/internal/disk_error.h"
#include "core/list_of.h"
#include "core/manifest.h"
#include "core/text.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

fs::path without_trailing_slash(const fs::path& path) {
  if (path.empty()) throw InputError("the output folder has no name");
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

bool is_taken(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  if (!fs::is_directory(path, error)) throw InputError(path, "exists and is not a folder");
  const bool empty = fs::is_empty(path, error);
  if (error) throw InputError(path, "cannot be read: {}", error.message());
  return !empty;
}

// Whether `path` is `folder` or lies in it; both are free of links.
bool is_within(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

// The path with links and dots resolved, as far as it exists.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(without_trailing_slash(path), error);
  return error ? without_trailing_slash(path) : real;
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
    throw InputError(folder, "exists and was not written by {} but by {}; choose another folder",
                     command, manifest["command"].dump());
  }
}

void require_replaceable_folder(const fs::path& folder, const std::string& command) {
  require_own_folder(folder, command);
  if (!is_taken(folder)) return;
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> strangers =
      list_of(unlisted_files(folder), [](const fs::path& file) { return file.string(); });
  if (strangers.empty()) return;
  const std::size_t more = strangers.size() - std::min(strangers.size(), kNamed);
  strangers.resize(strangers.size() - more);
  throw InputError(folder,
                   "is not replaced: it holds what {} did not write ({}{}); move that away, or "
                   "choose another folder",
                   command, joined(strangers, ", "),
                   more > 0 ? " and " + std::to_string(more) + " more" : "");
}

void require_apart(const fs::path& output, std::span<const fs::path> inputs) {
  const fs::path out = resolved(output);
  for (const fs::path& input : inputs) {
    const fs::path in =
        resolved(input.filename() == "manifest.json" ? fs::absolute(input).parent_path() : input);
    if (out == in) throw InputError(output, "is the input; choose another place");
    if (is_within(out, in))
      throw InputError(output, "lies in the input {}; choose a place outside of it", in.string());
    if (is_within(in, out))
      throw InputError(output, "holds the input {}; choose another place", in.string());
  }
}

OutputFolder::OutputFolder(const fs::path& final_path, bool replace, const std::string& command,
                           std::span<const fs::path> inputs)
    : final_(behind_link(without_trailing_slash(final_path))),
      command_(command),
      temporary_(partial_path(final_)) {
  require_apart(final_path, inputs);
  require_own_folder(final_, command);
  if (is_taken(final_) && !replace) throw InputError(final_path, "exists; --force replaces it");
  require_replaceable_folder(final_, command);
  std::error_code error;
  fs::remove_all(path(), error);
  fs::create_directories(path(), error);
  if (is_of_disk(error.value())) throw WriteError(final_path, error.value());
  if (error) throw InputError(final_path, "cannot be created: {}", error.message());
}

void OutputFolder::commit() {
  require_replaceable_folder(final_, command_);
  // If the file system can, old and new change places in one step: at no moment is there no whole
  // folder, and this object's destructor then removes the old one.
  if (renameat2(AT_FDCWD, path().c_str(), AT_FDCWD, final_.c_str(), RENAME_EXCHANGE) == 0) return;
  // There is no old folder, or the file system cannot exchange. Other failures keep the old folder.
  if (errno != ENOENT && errno != EINVAL && errno != ENOSYS) throw WriteError(final_, errno);
  std::error_code error;
  fs::remove_all(final_, error);
  if (!error) fs::rename(path(), final_, error);
  if (error) throw WriteError(final_, error.value());
}

}  // namespace plotscan
