// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plotscan::farmbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNotStarted = 127;  // as shells say it
constexpr auto kPause = std::chrono::milliseconds(2);
constexpr int kLooksAtMemory = 5;  // pauses from one look to the next, after as many at each
constexpr int kBegun = 3;          // the child's file that is closed when its program begins

// In the child: nothing that allocates, since another thread may have held the heap's lock. `begun`
// is closed when the program begins.
[[noreturn]] void become(char* const* arguments, const char* folder, const char* log, pid_t parent,
                         std::uint64_t memory_bytes, int begun) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit memory{memory_bytes, memory_bytes};
  setrlimit(RLIMIT_AS, &memory);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  if (begun != kBegun) dup3(begun, kBegun, O_CLOEXEC);
  close_range(kBegun + 1, ~0U, 0);
  if (chdir(folder) != 0) _exit(kNotStarted);
  execvp(arguments[0], arguments);
  _exit(kNotStarted);
}

// A pipe that ends for its reader when the child's program begins. Until then the child holds this
// program's memory.
struct Begun {
  int ends[2] = {-1, -1};

  Begun() {
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe can be made");
  }
  Begun(const Begun&) = delete;
  Begun& operator=(const Begun&) = delete;
  ~Begun() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  // A second at most: a child of another thread may hold the other end for a while.
  void wait() {
    close(std::exchange(ends[1], -1));
    pollfd end{.fd = ends[0], .events = POLLIN, .revents = 0};
    while (poll(&end, 1, 1000) < 0 && errno == EINTR) {
    }
  }
};

// The most memory that a process of the group has held, as far as it lives. (wait4 tells no less
// than this program held when it forked.)
std::uint64_t peak_bytes(pid_t group) {
  std::uint64_t most = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (getpgid(static_cast<pid_t>(std::stol(name))) != group) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("VmHWM:"))
        most = std::max<std::uint64_t>(most, 1024 * std::stoull(line.substr(6)));
  }
  return most;
}

// Whether more is in the file, which may not be there yet.
bool is_larger(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(file, missing);
  return !missing && size > bytes;
}

// Waits for its end. Why it has to be stopped before, "" where it ended by itself. It is not
// reaped, so that its number stays its own. `peak` becomes the most memory that was seen.
std::string reason_to_stop(pid_t process, const std::filesystem::path& log,
                           const ProcessLimits& limits, std::uint64_t& peak) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limits.seconds));
  for (int look = 0;; ++look) {
    if (look < kLooksAtMemory || look % kLooksAtMemory == 0)
      peak = std::max(peak, peak_bytes(process));
    siginfo_t info{};
    const int asked = waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOWAIT | WNOHANG);
    if (asked == 0 && info.si_pid == process) return "";
    if (asked != 0 && errno != EINTR) return "";
    if (Clock::now() >= end) return fmt::format("took more than {:g} s", limits.seconds);
    if (is_larger(log, limits.log_bytes))
      return fmt::format("printed more than {:g} MB", 1e-6 * static_cast<double>(limits.log_bytes));
    std::this_thread::sleep_for(kPause);
  }
}

std::string failure_of(int status, const std::string& stopped, const std::string& program,
                       const ProcessLimits& limits) {
  if (!stopped.empty()) return stopped + " and was stopped";
  if (WIFSIGNALED(status))
    return std::string("was ended by a signal (") + strsignal(WTERMSIG(status)) +
           fmt::format("); it may use {:.1f} GB of memory",
                       static_cast<double>(limits.memory_bytes) / 1e9);
  const int code = WEXITSTATUS(status);
  if (code == kNotStarted) return "ended with exit code 127: is there a program " + program + "?";
  return code == 0 ? "" : "ended with exit code " + std::to_string(code);
}

}  // namespace

FinishedProcess run_process(const std::vector<std::string>& arguments,
                            const std::filesystem::path& folder, const std::filesystem::path& log,
                            const ProcessLimits& limits) {
  std::vector<std::string> own = arguments;
  std::vector<char*> pointers;
  pointers.reserve(own.size() + 1);
  for (std::string& argument : own) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const std::string folder_text = folder.string();
  const std::string log_text = log.string();
  const pid_t parent = getpid();
  const auto start = Clock::now();
  Begun begun;
  const pid_t process = fork();
  if (process == 0)
    become(pointers.data(), folder_text.c_str(), log_text.c_str(), parent, limits.memory_bytes,
           begun.ends[1]);
  if (process < 0)
    throw std::system_error(errno, std::generic_category(), "no process can be started");
  setpgid(process, process);  // whichever of the two comes first
  begun.wait();
  int status = 0;
  std::uint64_t peak = 0;
  const std::string stopped = reason_to_stop(process, log, limits, peak);
  const std::chrono::duration<double> took = Clock::now() - start;
  kill(-process, SIGKILL);
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return {.failure = failure_of(status, stopped, arguments.front(), limits),
          .seconds = took.count(),
          .peak_bytes = peak};
}

}  // namespace plotscan::farmbench
