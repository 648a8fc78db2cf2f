// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/problems.h"

#include "core/error.h"

namespace plotscan::farmbench {

void Problems::add(const std::string& where, const std::string& what) {
  constexpr std::size_t kMostKept = 100;
  ++count_;
  if (kept_.size() < kMostKept) kept_.push_back(where + ": " + what);
}

void Problems::raise(const std::filesystem::path& folder) const {
  if (count_ == 0) return;
  std::string message = std::to_string(count_) + (count_ == 1 ? " problem:" : " problems:");
  for (const std::string& problem : kept_) message += "\n  " + problem;
  if (count_ > kept_.size())
    message += "\n  and " + std::to_string(count_ - kept_.size()) + " more";
  throw InputError(folder, message);
}

}  // namespace plotscan::farmbench
