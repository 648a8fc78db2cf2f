// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/farm_queue.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace plotscan::farmbench {
namespace {

// The mean of many works' progress.
class SharedProgress {
 public:
  SharedProgress(const ProgressReport& report, std::size_t count)
      : report_(report), step_(1.0 / static_cast<double>(count)), shares_(count) {}

  void set(std::size_t work, double share) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    done_ += (share - shares_[work]) * step_;
    shares_[work] = share;
    report_(std::min(done_, 1.0));
  }

 private:
  const ProgressReport& report_;
  double step_;
  std::mutex mutex_;
  std::vector<double> shares_;
  double done_ = 0;
};

}  // namespace

void run_queue(std::size_t count, int jobs, const ProgressReport& progress,
               const std::function<void(std::size_t, const ProgressReport&)>& work) {
  if (count == 0) return;
  SharedProgress shared(progress, count);
  std::atomic<std::size_t> next = 0;
  std::mutex failure_mutex;
  std::exception_ptr failure;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i, [&shared, i](double share) { shared.set(i, share); });
        shared.set(i, 1);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(count, static_cast<std::size_t>(jobs)); ++i)
      threads.emplace_back(worker);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace plotscan::farmbench
