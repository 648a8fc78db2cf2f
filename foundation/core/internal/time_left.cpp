// SPDX-License-Identifier: Apache-2.0
#include "core/internal/time_left.h"

#include <cmath>

namespace plotscan {

std::optional<double> TimeLeft::at(double now_s, double share) {
  if (share <= 0) {
    *this = {};
    start_s_ = now_s;
  }
  const double elapsed_s = now_s - start_s_;
  const double step_s = elapsed_s - before_s_;
  if (step_s > 0) {
    // Older speeds count less, by their age relative to the whole time.
    constexpr double kMemory = 1.0 / 3;
    const double kept = before_s_ > 0 ? std::exp(-step_s / (kMemory * elapsed_s)) : 0;
    speed_ = kept * speed_ + (1 - kept) * (share - before_share_) / step_s;
    before_s_ = elapsed_s;
    before_share_ = share;
  }
  if (elapsed_s < kSilent_s || speed_ <= 0) return std::nullopt;
  return (1 - share) / speed_;
}

}  // namespace plotscan
