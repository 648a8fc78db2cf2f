// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace plotscan {

// The resources that work in a process of its own may use.
struct IsolationLimits {
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;  // in addition to what this process has
  int processor_s = 60;  // of processor time; waiting is cut off at twenty times as much
};

// Runs `work` in a child process and returns what it returns: other people's parsers crash, loop
// and swallow memory on files that are made for it, and none of that reaches this process. The
// child's stdout and stderr lead nowhere; it leaves nothing but what it returns. Throws InputError
// - with the text of an InputError that `work` throws;
// - "WHAT: its reader ..." where it crashes, throws anything else or uses more than the limits.
// Builds with a sanitizer, which needs terabytes of addresses and tells what it finds, neither
// limit the memory nor quieten the child.
std::string run_isolated(const std::string& what, const IsolationLimits& limits,
                         const std::function<std::string()>& work);

}  // namespace plotscan
