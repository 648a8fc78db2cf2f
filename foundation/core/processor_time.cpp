// SPDX-License-Identifier: Apache-2.0
#include "core/processor_time.h"

#include <sys/resource.h>

namespace plotscan {
namespace {

double in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double used_s(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return in_seconds(usage.ru_utime) + in_seconds(usage.ru_stime);
}

}  // namespace

double processor_time_s() { return used_s(RUSAGE_SELF) + used_s(RUSAGE_CHILDREN); }

}  // namespace plotscan
