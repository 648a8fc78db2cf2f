// SPDX-License-Identifier: Apache-2.0
#include "core/program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/error.h"
#include "core/manifest.h"
#include "core/program_pages.h"
#include "core/temporary_path.h"

namespace plotscan {
namespace {

constexpr int kExitBadInput = 2;
constexpr int kExitNothingToMeasure = 3;
constexpr int kExitFailure = 1;
constexpr int kBarWidth = 30;

// Redraws one line on stderr, at most ten times a second; clears it when the work is done.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label) : label_(std::move(label)) {}
  // Work that ends early leaves no bar before its message.
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double share) {
    const auto now = Clock::now();
    if (share < 1 && now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    if (share >= 1) {
      clear();
      return;
    }
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const int filled = static_cast<int>(kBarWidth * std::clamp(share, 0.0, 1.0));
    std::fprintf(stderr, "\r%s [%s%s] %3.0f %%", label_.c_str(), std::string(filled, '#').c_str(),
                 std::string(kBarWidth - filled, '.').c_str(), 100 * share);
    if (share > 0) std::fprintf(stderr, ", %.0f s left\033[K", elapsed_s * (1 - share) / share);
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void clear() {
    if (drawn_ != Clock::time_point{}) std::fprintf(stderr, "\r\033[K");
  }

  std::string label_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

void log_to_stderr(int verbosity, const std::string& name) {
  auto logger = std::make_shared<spdlog::logger>("plotscan",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(name + ": %v");
  logger->set_level(verbosity < 0    ? spdlog::level::err
                    : verbosity == 0 ? spdlog::level::warn
                    : verbosity == 1 ? spdlog::level::info
                                     : spdlog::level::debug);
  spdlog::drop(logger->name());  // of an earlier run in the same process
  spdlog::register_logger(logger);
}

// SIGINT and SIGTERM are taken by a thread of their own, which may do what a signal handler may
// not: remove what the interrupted work has begun to write. The process then ends as interrupted
// programs do, with 128 + signal.
void remove_unfinished_work_on_interrupt() {
  sigset_t interrupts;
  sigemptyset(&interrupts);
  sigaddset(&interrupts, SIGINT);
  sigaddset(&interrupts, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
  std::thread([interrupts] {
    int signal = 0;
    sigwait(&interrupts, &signal);
    TemporaryPath::remove_all();
    _exit(128 + signal);
  }).detach();
}

}  // namespace

Program::Program(std::string name, const std::string& description)
    : name_(std::move(name)), app_(description, name_) {
  app_.set_version_flag("--version", name_ + " " + version());
  app_.require_subcommand(1);
  // For whoever packages the programs: no group, so that --help does not show them.
  add_page("--print-manual", &manual_page);
  add_page("--print-bash-completion", &bash_completion);
}

void Program::add_page(const std::string& flag, std::string (*page)(const CLI::App&)) {
  const auto print = [this, page] {
    std::cout << page(app_);
    throw CLI::Success();
  };
  app_.add_flag_callback(flag, print)->group("");
}

CLI::App& Program::command(const std::string& name, const std::string& description,
                           std::function<void()> run) {
  CLI::App& command = *app_.add_subcommand(name, description);
  command.option_defaults()->always_capture_default();
  command.set_version_flag("--version", name_ + " " + version());
  const CLI::Option* seed =
      command.add_option("--seed", common_.seed, "seed of all random numbers, 0 and up")
          ->check(CLI::NonNegativeNumber);
  command.add_option("-j,--threads", common_.threads, "threads; 0 is one for each processor")
      ->check(CLI::Range(0, 1024));
  command.add_flag("-v,--verbose", common_.verbosity, "say more on stderr (-vv: debug)");
  command.add_flag("-q,--quiet", quiet_, "say nothing but errors");
  command.add_flag("--json", common_.json, "print the result as one JSON document");
  command.callback([this, seed, run = std::move(run)] {
    common_.seed_given = seed->count() > 0;
    if (common_.threads == 0)
      common_.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (quiet_ > 0) common_.verbosity = -1;
    log_to_stderr(common_.verbosity, name_);
    run();
  });
  return command;
}

int Program::run(int argc, char** argv) {
  remove_unfinished_work_on_interrupt();
  try {
    return guarded_run(argc, argv);
  } catch (const NothingToMeasure& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kExitNothingToMeasure;
  } catch (const InputError& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << name_ << ": " << error.path1().string() << ": " << error.code().message() << '\n';
    return kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kExitFailure;
  }
}

int Program::guarded_run(int argc, char** argv) {
  try {
    app_.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    const bool asked_for = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app_.exit(error);
    return asked_for ? 0 : kExitBadInput;
  }
}

void Program::say(const std::string& line) const {
  if (!common_.json && common_.verbosity >= 0) std::cout << line << '\n';
}

void Program::log(const std::string& line) const {
  if (common_.verbosity >= 0 && isatty(STDERR_FILENO) == 0) std::cerr << line << '\n';
}

void Program::result(const nlohmann::json& document) const {
  if (common_.json) std::cout << document.dump(1) << '\n';
}

ProgressReport Program::progress(const std::string& label) const {
  if (common_.json || common_.verbosity < 0 || isatty(STDERR_FILENO) == 0) return {};
  return [bar = std::make_shared<ProgressBar>(label)](double share) { bar->show(share); };
}

}  // namespace plotscan
