// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <tbb/concurrent_queue.h>

namespace plotscan::cloud {

// Hands points to a sink in a thread of its own, in their order, while the caller reads the next
// ones; without a second thread, at once.
class BackgroundSink {
 public:
  using Sink = std::function<void(std::span<const Eigen::Vector3d>)>;

  BackgroundSink(Sink sink, int threads);
  // Waits for the sink, and ignores its error: one that is left here follows a failed read.
  ~BackgroundSink();
  BackgroundSink(const BackgroundSink&) = delete;
  BackgroundSink& operator=(const BackgroundSink&) = delete;

  // Copies the points. Throws what the sink threw on earlier ones.
  void add(std::span<const Eigen::Vector3d> points);
  // Waits until the sink has all points. Throws what it threw.
  void finish();

 private:
  using Points = std::vector<Eigen::Vector3d>;

  void hand_on();

  Sink sink_;
  tbb::concurrent_bounded_queue<Points> waiting_;  // none: no more are to come
  std::atomic<bool> failed_ = false;
  std::future<void> handing_on_;  // last: it uses the others
};

}  // namespace plotscan::cloud
