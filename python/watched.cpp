// SPDX-License-Identifier: Apache-2.0
#include "watched.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace plotscan::python {
namespace py = pybind11;
namespace {

// Thrown in the work's thread to end it; never seen outside.
struct Stopped {};

// Work in a thread of its own, and what it says to the thread that waits for it.
class WorkThread {
 public:
  explicit WorkThread(const std::function<void(const Progress&)>& work)
      : thread_([this, &work] { run(work); }) {}
  ~WorkThread() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    if (thread_.joinable()) thread_.join();
  }
  WorkThread(const WorkThread&) = delete;
  WorkThread& operator=(const WorkThread&) = delete;

  // Waits until the share done is another than `known`, the work has ended, or some time has
  // passed.
  double wait(double known) {
    constexpr std::chrono::milliseconds kPatience(50);  // a person who hits Ctrl-C sees no delay
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [&] { return ended_ || share_ != known; });
    return share_;
  }
  bool ended() {
    const std::lock_guard lock(mutex_);
    return ended_;
  }
  // Of ended work: throws what it threw.
  void finish() {
    thread_.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void run(const std::function<void(const Progress&)>& work) {
    try {
      work([this](double share) { report(share); });
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_one();
  }
  void report(double share) {
    const std::lock_guard lock(mutex_);
    if (stopped_) throw Stopped();
    share_ = share;
    changed_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  double share_ = 0;
  bool ended_ = false;
  bool stopped_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace

void watch(const py::object& progress, const std::function<void(const Progress&)>& work) {
  const py::gil_scoped_release unlocked;
  WorkThread thread(work);
  double told = 0;
  while (true) {
    const bool ended = thread.ended();
    const double share = thread.wait(told);
    {
      const py::gil_scoped_acquire locked;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (share != told && !progress.is_none()) progress(share);
    }
    told = share;
    if (ended) break;
  }
  thread.finish();
  const py::gil_scoped_acquire locked;
  if (told < 1 && !progress.is_none()) progress(1.0);
}

}  // namespace plotscan::python
