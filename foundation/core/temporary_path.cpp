// SPDX-License-Identifier: Apache-2.0
#include "core/temporary_path.h"

#include <cerrno>
#include <csignal>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/internal/raw_folder.h"
#include "core/parse.h"

namespace plotscan {
namespace {

// A signal handler has no access to the objects, so the paths of all living ones are kept here.
struct LivingPaths {
  std::mutex mutex;
  std::multiset<std::string> paths;
};

LivingPaths& living() {
  static LivingPaths paths;
  return paths;
}

// The number in a name made of `begin`, a positive number and `end`; absent for any other name.
std::optional<pid_t> number_between(std::string_view name, std::string_view begin,
                                    std::string_view end) {
  const bool framed =
      name.size() > begin.size() + end.size() && name.starts_with(begin) && name.ends_with(end);
  if (!framed) return {};
  name.remove_prefix(begin.size());
  name.remove_suffix(end.size());
  const auto number = parsed<pid_t>(name);
  return number && *number > 0 ? number : std::nullopt;
}

// A zombie, which has ended but was not yet waited for by its parent, counts as gone.
bool is_gone(pid_t process) {
  if (kill(process, 0) != 0) return errno == ESRCH;
  // "PROCESS (NAME) STATE ..."; the name may hold anything.
  std::string status;
  std::getline(std::ifstream("/proc/" + std::to_string(process) + "/stat"), status);
  const std::size_t name_end = status.rfind(") ");
  return name_end != std::string::npos && status.substr(name_end + 2).starts_with('Z');
}

// Removes what processes that are gone left under the same name but for the process number.
void sweep(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::string own = "-" + std::to_string(getpid());
  const std::size_t number = name.rfind(own);
  if (number == std::string::npos || !name.starts_with('.')) return;
  const std::string begin = name.substr(0, number + 1);
  const std::string end = name.substr(number + own.size());
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(
           path.has_parent_path() ? path.parent_path() : ".", error)) {
    const auto process = number_between(entry.path().filename().string(), begin, end);
    if (process && is_gone(*process)) remove_tree(AT_FDCWD, entry.path().c_str());
  }
}

// What partial_path puts between a name and its extension.
std::string own_mark() { return ".partial-" + std::to_string(getpid()); }

// The final name for a partial one; any other name unchanged.
std::string shown_name(const std::string& name) {
  const std::string mark = own_mark();
  const std::size_t at = name.find(mark, 1);
  if (!name.starts_with('.') || at == std::string::npos) return name;
  const std::string end = name.substr(at + mark.size());
  return end.empty() || end.starts_with('.') ? name.substr(1, at - 1) + end : name;
}

}  // namespace

TemporaryPath::TemporaryPath(std::filesystem::path path) : path_(std::move(path)) {
  sweep(path_);
  const std::lock_guard lock(living().mutex);
  living().paths.insert(path_.string());
}

TemporaryPath::~TemporaryPath() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  const std::lock_guard lock(living().mutex);
  living().paths.erase(living().paths.find(path_.string()));
}

void TemporaryPath::remove_all(void (*halt)()) {
  const std::lock_guard lock(living().mutex);
  halt();
  for (const std::string& path : living().paths) remove_tree(AT_FDCWD, path.c_str());
}

std::filesystem::path partial_path(const std::filesystem::path& final_path) {
  return final_path.parent_path() /
         ("." + final_path.stem().string() + own_mark() + final_path.extension().string());
}

std::filesystem::path behind_link(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

std::filesystem::path shown_path(const std::filesystem::path& path) {
  if (path.string().find(own_mark()) == std::string::npos) return path;
  std::filesystem::path shown;
  for (const std::filesystem::path& part : path) shown /= shown_name(part.string());
  return shown;
}

}  // namespace plotscan
