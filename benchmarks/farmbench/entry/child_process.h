// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plotscan::farmbench {

// Limits on what another party's program may use.
struct ProcessLimits {
  double seconds = 3600;                                // of the clock
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  // of addresses, each of its processes
  std::uintmax_t log_bytes = 1'000'000'000;             // of stdout and stderr
};

// How it ended.
struct FinishedProcess {
  std::string failure;  // "" where it ended with exit code 0, else one sentence
  double seconds = 0;   // of the clock
  // Peak resident memory of its largest process, as sampled every 10 ms.
  std::uint64_t peak_bytes = 0;
};

// Runs a program (found along PATH if its name has no slash) with these arguments, without a shell,
// in `folder`, and waits for its end. Its stdin is empty, its stdout and stderr go to the file
// `log`. When it ends, or is beyond its time or its log's size, it and its remaining children are
// killed. Throws std::system_error where no process can be made.
FinishedProcess run_process(const std::vector<std::string>& arguments,
                            const std::filesystem::path& folder, const std::filesystem::path& log,
                            const ProcessLimits& limits);

}  // namespace plotscan::farmbench
