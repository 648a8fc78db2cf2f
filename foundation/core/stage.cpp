// SPDX-License-Identifier: Apache-2.0
#include "core/stage.h"

#include <utility>

#include <spdlog/spdlog.h>

namespace plotscan {

Stage::Stage(std::string name) : name_(std::move(name)) {}

Stage::~Stage() {
  const double seconds = watch_.seconds();
  const double processor_s = processor_time_s() - processor_start_s_;
  if (const auto logger = spdlog::get("plotscan"))
    logger->info("{:<24} {:7.3f} s  {:7.3f} s of processors{}{}", name_, seconds, processor_s,
                 found_.empty() ? "" : "  ", found_);
}

}  // namespace plotscan
