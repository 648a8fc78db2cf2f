// SPDX-License-Identifier: Apache-2.0
#include "core/internal/interrupt.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/internal/raw_folder.h"
#include "core/temporary_path.h"

namespace plotscan {
namespace {

// The signal that stops other threads; nothing else in the program sends it.
int halt_signal() { return SIGRTMAX - 1; }

std::atomic<int> halted{0};

// Where an interrupted thread spends the rest of its life.
void halt(int /*signal*/) {
  ++halted;
  for (;;) pause();
}

// The longest wait for a thread that is in a system call, on a slow disk for example.
constexpr auto kPatience = std::chrono::seconds(5);

// Halts every other thread. Allocates nothing, as these threads may hold the heap's locks.
void halt_other_threads() {
  constexpr int kMostThreads = 4096;
  static std::array<pid_t, kMostThreads> signalled{};
  int count = 0;
  const pid_t process = getpid();
  const pid_t own = gettid();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  for (bool found = true; found && std::chrono::steady_clock::now() < end;) {
    found = false;
    const int tasks = open("/proc/self/task", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for_each_name(tasks, [&](const char* name) {
      pid_t thread = 0;
      std::from_chars(name, name + std::strlen(name), thread);
      const bool known = std::find(signalled.begin(), signalled.begin() + count, thread) !=
                         signalled.begin() + count;
      if (thread <= 0 || thread == own || known || count == kMostThreads) return;
      if (syscall(SYS_tgkill, process, thread, halt_signal()) != 0) return;
      signalled[static_cast<std::size_t>(count++)] = thread;
      found = true;
    });
    close(tasks);
    while (halted < count && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace

void remove_unfinished_work_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = halt;
  sigaction(halt_signal(), &action, nullptr);
  sigset_t interrupts;
  sigemptyset(&interrupts);
  sigaddset(&interrupts, SIGINT);
  sigaddset(&interrupts, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
  std::thread([interrupts] {
    int signal = 0;
    sigwait(&interrupts, &signal);
    TemporaryPath::remove_all(halt_other_threads);
    _exit(128 + signal);
  }).detach();
}

}  // namespace plotscan
