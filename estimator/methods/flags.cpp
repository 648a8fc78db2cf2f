// SPDX-License-Identifier: Apache-2.0
#include "methods/flags.h"

#include "heights/flags.h"

namespace plotscan::methods {

bool concerns(const std::string& flag, const std::string& height) {
  return flag != heights::kUnsureMean || height == "mean";
}

}  // namespace plotscan::methods
