// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace plotscan {

// Estimates how long work will still take, from the speed over about the last third of the time so
// far: neither a slow start nor a single slow piece decides it.
class TimeLeft {
 public:
  // Reports that `share` (0 to 1) of the work was done at `now_s`; both must grow. The work begins
  // at 0 s, or when a share of 0 is reported. Returns the seconds left; absent in the first
  // kSilent_s, too early to tell.
  std::optional<double> at(double now_s, double share);

  static constexpr double kSilent_s = 2;

 private:
  double start_s_ = 0;
  double before_s_ = 0;  // after the start
  double before_share_ = 0;
  double speed_ = 0;  // share a second, smoothed
};

}  // namespace plotscan
