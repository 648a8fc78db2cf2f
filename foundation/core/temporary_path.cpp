// SPDX-License-Identifier: Apache-2.0
#include "core/temporary_path.h"

#include <mutex>
#include <set>
#include <string>
#include <utility>

#include <unistd.h>

namespace plotscan {
namespace {

// An interrupt comes from outside and knows no object, so the living paths are kept here.
struct LivingPaths {
  std::mutex mutex;
  std::multiset<std::filesystem::path> paths;
};

LivingPaths& living() {
  static LivingPaths paths;
  return paths;
}

}  // namespace

TemporaryPath::TemporaryPath(std::filesystem::path path) : path_(std::move(path)) {
  const std::lock_guard lock(living().mutex);
  living().paths.insert(path_);
}

TemporaryPath::~TemporaryPath() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  const std::lock_guard lock(living().mutex);
  living().paths.erase(living().paths.find(path_));
}

void TemporaryPath::remove_all() {
  const std::lock_guard lock(living().mutex);
  for (const std::filesystem::path& path : living().paths) {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
}

std::filesystem::path partial_path(const std::filesystem::path& final_path) {
  return final_path.parent_path() / ("." + final_path.stem().string() + ".partial-" +
                                     std::to_string(getpid()) + final_path.extension().string());
}

}  // namespace plotscan
