// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace plotscan {

// How long work still takes, from the shares done so far: the speed of about the last third of the
// time, so that neither a slow start nor one slow piece decides.
class TimeLeft {
 public:
  // At `elapsed_s` since the start, the share in [0, 1] was done; both grow. Returns seconds;
  // nothing in the first kSilent_s, when nobody can tell.
  std::optional<double> at(double elapsed_s, double share);

  static constexpr double kSilent_s = 2;

 private:
  double before_s_ = 0;
  double before_share_ = 0;
  double speed_ = 0;  // share a second, smoothed
};

}  // namespace plotscan
