// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/farm_queue.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

namespace plotscan::farmbench {

void run_queue(std::size_t count, int jobs, const ProgressReport& progress,
               const std::function<void(std::size_t, const ProgressReport&)>& work) {
  if (count == 0) return;
  std::mutex mutex;  // of the shares and of the failure
  std::vector<double> shares(count);
  std::exception_ptr failure;
  const auto report = [&](std::size_t i, double share) {
    if (!progress) return;
    const std::lock_guard lock(mutex);
    shares[i] = share;
    progress(std::reduce(shares.begin(), shares.end()) / static_cast<double>(count));
  };
  std::atomic<std::size_t> next = 0;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i, [&report, i](double share) { report(i, share); });
        report(i, 1);
      } catch (...) {
        const std::lock_guard lock(mutex);
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
