// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/processor_time.h"
#include "core/stopwatch.h"

namespace plotscan {

// A stage of long work. Its destructor logs its name, the seconds it took, the processor seconds
// that the whole program used meanwhile, and the text that found() got. It logs to spdlog's logger
// "plotscan", which programs register and -v shows; without that logger nothing is logged.
class Stage {
 public:
  explicit Stage(std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Sets what the stage's log line counts, such as "30 plots".
  void found(std::string what) { found_ = std::move(what); }

 private:
  std::string name_, found_;
  Stopwatch watch_;
  double processor_start_s_ = processor_time_s();
};

}  // namespace plotscan
