// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace plotscan {

// The resources that work in a process of its own may use.
struct IsolationLimits {
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;  // in addition to what this process has
  int processor_s = 60;  // of processor time; waiting is cut off at twenty times as much
  // A child that uses no processor time and sends nothing for so long is started anew, twice at
  // most: a lock that another thread held when the child was forked never opens in it.
  std::chrono::milliseconds idle{10'000};
};

// Runs `work` in a child process and returns what it returns: third-party parsers may crash, loop
// or use up memory on malicious files, and this process stays unharmed. The child's stdout and
// stderr are discarded: it leaves only what it returns. Throws InputError
// - with the text of an InputError that `work` throws;
// - "WHAT: its reader ..." where it crashes, throws anything else or uses more than the limits.
// Builds with a sanitizer neither limit the memory nor silence the child, as sanitizers need
// terabytes of address space and print what they find.
std::string run_isolated(const std::string& what, const IsolationLimits& limits,
                         const std::function<std::string()>& work);

}  // namespace plotscan
