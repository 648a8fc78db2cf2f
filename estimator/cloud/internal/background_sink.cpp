// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/background_sink.h"

#include <exception>
#include <utility>

namespace plotscan::cloud {

BackgroundSink::BackgroundSink(Sink sink, int threads) : sink_(std::move(sink)) {
  constexpr std::ptrdiff_t kMostWaiting = 16;
  waiting_.set_capacity(kMostWaiting);
  if (threads > 1) handing_on_ = std::async(std::launch::async, [this] { hand_on(); });
}

BackgroundSink::~BackgroundSink() {
  if (handing_on_.valid()) waiting_.push({});
}

void BackgroundSink::add(std::span<const Eigen::Vector3d> points) {
  if (!handing_on_.valid()) return sink_(points);
  if (failed_) finish();
  if (!points.empty()) waiting_.push({points.begin(), points.end()});
}

void BackgroundSink::finish() {
  if (!handing_on_.valid()) return;
  waiting_.push({});
  handing_on_.get();
}

// After an error it goes on taking points, so that nobody waits for a place in the queue.
void BackgroundSink::hand_on() {
  std::exception_ptr error;
  for (Points points; waiting_.pop(points), !points.empty();) {
    try {
      if (!error) sink_(points);
    } catch (...) {
      error = std::current_exception();
      failed_ = true;
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace plotscan::cloud
