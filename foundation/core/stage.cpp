// SPDX-License-Identifier: Apache-2.0
#include "core/stage.h"

#include <utility>

#include <spdlog/spdlog.h>

namespace plotscan {

Stage::Stage(std::string name) : name_(std::move(name)) {}

Stage::~Stage() {
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
  if (const auto logger = spdlog::get("plotscan"))
    logger->info("{:<24} {:6.2f} s  {}", name_, seconds.count(), found_);
}

}  // namespace plotscan
