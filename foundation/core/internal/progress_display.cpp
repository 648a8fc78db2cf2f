// SPDX-License-Identifier: Apache-2.0
#include "core/internal/progress_display.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

namespace plotscan {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kRedrawn = std::chrono::milliseconds(100);
constexpr auto kLine = std::chrono::seconds(10);

}  // namespace

ProgressDisplay::ProgressDisplay(std::string label)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressDisplay::~ProgressDisplay() { clear(); }

void ProgressDisplay::show(double share) {
  if (share >= 1) {
    clear();
    return;
  }
  const auto now = Clock::now();
  const auto left_s = time_left_.at(std::chrono::duration<double>(now - start_).count(), share);
  if (now - shown_ < (terminal_ ? Clock::duration(kRedrawn) : Clock::duration(kLine))) return;
  shown_ = now;
  draw(share, left_s);
}

void ProgressDisplay::draw(double share, std::optional<double> left_s) {
  std::string line = label_;
  if (terminal_) {
    const auto filled = static_cast<std::size_t>(kBarWidth * std::clamp(share, 0.0, 1.0));
    line += " [" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "]";
  }
  line += fmt::format(" {:3.0f} %", 100 * share);
  if (left_s) line += fmt::format(", {:.0f} s left", *left_s);
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressDisplay::clear() {
  if (terminal_ && drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace plotscan
