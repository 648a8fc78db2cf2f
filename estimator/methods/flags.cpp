// SPDX-License-Identifier: Apache-2.0
#include "methods/flags.h"

#include "heights/flags.h"

namespace plotscan::methods {

bool concerns(const std::string& flag, const std::string& height) {
  return heights::height_of_flag(flag).value_or(height) == height;
}

}  // namespace plotscan::methods
