// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/internal/time_left.h"

namespace plotscan {

// Long work's progress on stderr: on a terminal one line, redrawn at most ten times a second and
// cleared when the work is done; elsewhere a line every ten seconds.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(std::string label);
  // Clears the bar, also when work ends early: its error message then starts on a clean line.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(double share, std::optional<double> left_s);
  void clear();

  std::string label_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
  bool drawn_ = false;
  TimeLeft time_left_;
};

}  // namespace plotscan
