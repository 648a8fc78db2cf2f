// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "core/processor_time.h"

namespace plotscan {

// A stage of long work. Where it ends, -v tells its name, the seconds it took, those of processors
// that the whole program used meanwhile, and what it counted: spdlog's logger "plotscan" does,
// which programs register; where there is none, nothing is said.
class Stage {
 public:
  explicit Stage(std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // What came out of it, such as "30 plots".
  void found(std::string what) { found_ = std::move(what); }

 private:
  std::string name_, found_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double processor_start_s_ = processor_time_s();
};

}  // namespace plotscan
