// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::testing {

// What a command left behind.
struct Finished {
  int exit_code = -1;
  std::string output;  // stdout
  std::string errors;  // stderr
};

// Runs a program of the build ("farmgen generate ...") through the shell, in `folder`.
Finished run(const std::string& command, const std::string& folder);

}  // namespace plotscan::testing
