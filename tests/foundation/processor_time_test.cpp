// SPDX-License-Identifier: Apache-2.0
#include "core/processor_time.h"

#include <cstdlib>
#include <ctime>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plotscan {
namespace {

constexpr double kBusy_s = 0.05;
constexpr double kTick_s = 0.011;  // what a kernel may round to

// Until this process alone has used so many seconds more, by the C library's clock.
void keep_busy() {
  const std::clock_t start = std::clock();
  while (static_cast<double>(std::clock() - start) < kBusy_s * CLOCKS_PER_SEC) continue;
}

TEST(ProcessorTime, CountsThisProcess) {
  const double start_s = processor_time_s();
  keep_busy();
  EXPECT_GE(processor_time_s() - start_s, kBusy_s - kTick_s);
}

TEST(ProcessorTime, CountsChildrenThatWereWaitedFor) {
  const double start_s = processor_time_s();
  const pid_t child = fork();
  if (child == 0) {
    keep_busy();
    std::_Exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_GE(processor_time_s() - start_s, kBusy_s - kTick_s);
}

TEST(ProcessorTime, CountsNoWaiting) {
  const double start_s = processor_time_s();
  usleep(200'000);
  EXPECT_LT(processor_time_s() - start_s, 0.1);
}

}  // namespace
}  // namespace plotscan
