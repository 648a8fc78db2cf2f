// SPDX-License-Identifier: Apache-2.0
#include "core/isolated.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PLOTSCAN_SANITIZED 1
#else
#define PLOTSCAN_SANITIZED 0
#endif

namespace plotscan {
namespace {

constexpr int kWaitingFactor = 20;
// How often work is started while its child processes hang at once.
constexpr int kStarts = 3;

// The first byte of what the child sends; the rest is the result or a message.
enum class Outcome : char { done = 'd', bad_input = 'i', no_memory = 'm', failed = 'f' };

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit value{};
  getrlimit(resource, &value);
  value.rlim_cur = std::min(most, value.rlim_max);
  setrlimit(resource, &value);
}

// The bytes of address space that this process uses.
std::uint64_t taken_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void confine(const IsolationLimits& limits, pid_t parent) {
  // When the parent dies, by an interrupt for example, the kernel kills the child.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.processor_s));
  if (PLOTSCAN_SANITIZED != 0) return;  // a sanitizer must be able to print its findings
  limit(RLIMIT_AS, taken_bytes() + limits.memory_bytes);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

void send(int pipe, Outcome outcome, const std::string& text) {
  const auto write_all = [pipe](const char* bytes, std::size_t count) {
    while (count > 0) {
      const ssize_t written = write(pipe, bytes, count);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) _exit(1);
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
  };
  write_all(reinterpret_cast<const char*>(&outcome), 1);
  write_all(text.data(), text.size());
}

// Runs in the child and ends it without destructors: the parent's objects are not destroyed twice.
[[noreturn]] void work_and_exit(int pipe, const std::function<std::string()>& work) {
  try {
    send(pipe, Outcome::done, work());
  } catch (const InputError& error) {
    send(pipe, Outcome::bad_input, error.what());
  } catch (const std::bad_alloc&) {
    send(pipe, Outcome::no_memory, "");
  } catch (const std::exception& error) {
    send(pipe, Outcome::failed, error.what());
  } catch (...) {
    send(pipe, Outcome::failed, "unknown exception");
  }
  _exit(0);
}

// Waits for the process and returns its wait status; -1 if the system does not tell.
int reaped(pid_t process) {
  int status = -1;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// A child process and the reading end of its pipe. The destructor kills a child that nobody waited
// for.
class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ > 0) end();
  }

  int pipe() const { return pipe_; }
  // The processor time that it has used; nothing once it has ended.
  std::optional<std::chrono::nanoseconds> processor_time() const {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }
  // Waits for its end and returns its wait status.
  int wait() {
    close(pipe_);
    return reaped(std::exchange(process_, -1));
  }
  int end() {
    kill(process_, SIGKILL);
    return wait();
  }

 private:
  pid_t process_;
  int pipe_;
};

// Children start one at a time: one that inherited another's end of a pipe would keep it open.
Child start(const IsolationLimits& limits, const std::function<std::string()>& work) {
  static std::mutex starting;
  const std::lock_guard lock(starting);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe can be made");
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    confine(limits, parent);
    work_and_exit(ends[1], work);
  }
  const int error = errno;
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    throw std::system_error(error, std::generic_category(), "no process can be started");
  }
  return Child(process, ends[0]);
}

enum class Reception { whole, hung, late };

struct Patience {
  std::chrono::seconds all;        // until the child has sent everything
  std::chrono::milliseconds idle;  // without a byte from it, and without processor time
};

// Receives everything that the child sends.
Reception receive(const Child& child, const Patience& patience, std::string& received) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + patience.all;
  auto used = child.processor_time();
  std::string part(std::size_t{1} << 18, '\0');
  for (;;) {
    const auto pause = std::chrono::duration_cast<std::chrono::milliseconds>(
        std::min<Clock::duration>(end - Clock::now(), patience.idle));
    pollfd waiting{.fd = child.pipe(), .events = POLLIN, .revents = 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::max<long long>(pause.count(), 0)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0 || Clock::now() >= end) return Reception::late;
    if (ready == 0) {
      const auto before = std::exchange(used, child.processor_time());
      if (used && used == before) return Reception::hung;
      continue;
    }
    const ssize_t count = read(child.pipe(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Reception::whole;
    received.append(part.data(), static_cast<std::size_t>(count));
  }
}

// How one child ended, and what it had sent.
struct Ending {
  Reception reception = Reception::late;
  int status = -1;  // of waiting for it
  std::string received;
};

Ending run_once(const IsolationLimits& limits, const Patience& patience,
                const std::function<std::string()>& work) {
  Child child = start(limits, work);
  Ending ending;
  ending.reception = receive(child, patience, ending.received);
  ending.status = ending.reception == Reception::whole ? child.wait() : child.end();
  return ending;
}

// A child inherits the locks that other threads hold while it is forked, but not these threads: it
// may wait for ever. Another child rarely meets the same; the last is given all the time, as a disk
// may be slow.
Ending run_until_it_ends(const IsolationLimits& limits, const std::function<std::string()>& work) {
  const std::chrono::seconds all(kWaitingFactor * limits.processor_s);
  for (int tried = 1; tried < kStarts; ++tried) {
    Ending ending = run_once(limits, {.all = all, .idle = limits.idle}, work);
    if (ending.reception != Reception::hung) return ending;
  }
  return run_once(limits, {.all = all, .idle = all}, work);
}

std::string reason_of(const Ending& ending, const IsolationLimits& limits) {
  const int status = ending.status;
  const bool killed = WIFSIGNALED(status);
  if (ending.reception != Reception::whole) return "came to no end";
  if (killed && WTERMSIG(status) == SIGXCPU)
    return "takes more than " + std::to_string(limits.processor_s) + " s";
  if (killed) {
    return std::string("crashed (") + strsignal(WTERMSIG(status)) +
           "); the file is broken, or nested too deeply";
  }
  return "ended without a word";
}

}  // namespace

std::string run_isolated(const std::string& what, const IsolationLimits& limits,
                         const std::function<std::string()>& work) {
  Ending ending = run_until_it_ends(limits, work);
  const bool ended = ending.reception == Reception::whole && WIFEXITED(ending.status) &&
                     WEXITSTATUS(ending.status) == 0 && !ending.received.empty();
  if (!ended) throw InputError(fmt::format("{}: its reader {}", what, reason_of(ending, limits)));
  std::string received = std::move(ending.received);
  const auto outcome = static_cast<Outcome>(received.front());
  received.erase(0, 1);
  switch (outcome) {
    case Outcome::done:
      return received;
    case Outcome::bad_input:
      throw InputError(received);
    case Outcome::no_memory:
      throw InputError(fmt::format("{}: its reader needs more than {:.1f} GB of memory", what,
                                   static_cast<double>(limits.memory_bytes) / 1e9));
    default:
      throw InputError(fmt::format("{}: its reader failed: {}", what, received));
  }
}

}  // namespace plotscan
