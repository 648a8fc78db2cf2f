// SPDX-License-Identifier: Apache-2.0
#include "core/program.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <system_error>
#include <thread>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/internal/interrupt.h"
#include "core/internal/program_help.h"
#include "core/internal/program_pages.h"
#include "core/internal/progress_display.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/nearest_name.h"
#include "core/parse.h"
#include "core/printable.h"
#include "core/text.h"

namespace plotscan {
namespace {

constexpr int kExitBadInput = 2;
constexpr int kExitNothingToMeasure = 3;
constexpr int kExitFailure = 1;

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

// `message` may quote files and arguments of unknown origin, so it is made printable.
void say_error(const std::string& program, const std::string& message) {
  std::cerr << program << ": " << printable(message) << '\n';
}

// Takes only plain decimals: CLI11's own conversion turns too large numbers into the largest seed.
std::uint64_t seed_of(const std::string& text) {
  if (const auto seed = parsed<std::uint64_t>(text)) return *seed;
  throw CLI::ValidationError("--seed",
                             "\"" + text + "\" is not a whole number in [0, 18446744073709551615]");
}

// The names that a program or command knows: commands, or options of the long kind.
std::vector<std::string> names_of(const CLI::App& app, bool options) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({}))
    if (!options) names.push_back(command->get_name());
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      if (options) names.push_back("--" + name);
  return names;
}

// CLI11's message as people say it.
std::string plain_words(const std::string& message) {
  const std::string conversion = "Could not convert: ";
  if (message.starts_with(conversion))
    return message.substr(conversion.size()) + " cannot be read as a number";
  const auto repeated = message.find(": At Most 1 required");
  if (repeated != std::string::npos)
    return message.substr(0, repeated) + " is given more than once";
  return message;
}

}  // namespace

Program::Program(std::string name, const std::string& description)
    : name_(std::move(name)), app_(description, name_) {
  app_.set_version_flag("--version", name_ + " " + version());
  app_.require_subcommand(1);
  app_.formatter(std::make_shared<HelpFormatter>());
  // For whoever packages the programs: no group, so that --help does not show them.
  add_page("--print-manual", &manual_page);
  add_page("--print-bash-completion", &bash_completion);
  add_page("--print-zsh-completion", &zsh_completion);
  add_page("--print-fish-completion", &fish_completion);
}

void Program::add_page(const std::string& flag, std::string (*page)(const CLI::App&)) {
  const auto print = [this, page] {
    std::cout << page(app_);
    throw CLI::Success();
  };
  app_.add_flag_callback(flag, print)->group("");
}

CLI::App& Program::command(const std::string& name, const std::string& description,
                           std::function<void()> run, const Uses& uses) {
  CLI::App& command = *app_.add_subcommand(name, description);
  command.option_defaults()->always_capture_default();
  command.callback([this, run = std::move(run)] {
    if (common_.threads == 0)
      common_.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (quiet_) common_.verbosity = -1;
    log_to_stderr(common_.verbosity, name_);
    run();
  });
  commands_.emplace_back(&command, uses);
  return command;
}

void Program::add_common_options(CLI::App& command, const Uses& uses) {
  command.set_help_flag();  // --help tells options in the order of their declaration
  command.option_defaults()->group("Common options");
  if (uses.seed != nullptr) {
    const auto take = [this](const std::string& text) {
      common_.seed = seed_of(text);
      common_.seed_given = true;
    };
    command.add_option_function<std::string>("--seed", take, uses.seed)
        ->type_name("UINT")
        ->default_str(std::to_string(common_.seed));
  }
  if (uses.threads)
    command.add_option("-j,--threads", common_.threads, "threads to work with")
        ->check(CLI::Range(0, 1024))
        ->default_str("0, one for each processor");
  if (uses.json) command.add_flag("--json", common_.json, "print the result as one JSON document");
  // Every command has this flag. CLI11 2.4 would set a number that it counts into to 0 again for
  // each command that was not called.
  const auto say_more = [this](std::int64_t times) {
    common_.verbosity = std::max(common_.verbosity, static_cast<int>(times));
  };
  command.add_flag_function("-v,--verbose", say_more, "say more on stderr (-vv: debug)");
  command.add_flag("-q,--quiet", quiet_, "say nothing but errors");
  command.set_version_flag("--version", name_ + " " + version(), "print the version and exit");
  command.set_help_flag("-h,--help", "print this help and exit");
}

int Program::run(int argc, char** argv) {
  // Without this, a limit on file sizes would kill the process instead of failing the write.
  std::signal(SIGXFSZ, SIG_IGN);
  // Without this, a pipe's reader that goes away would kill it and leave unfinished work behind.
  // Caught rather than ignored: programs that this one starts get the default again.
  std::signal(SIGPIPE, [](int /*signal*/) {});
  remove_unfinished_work_on_interrupt();
  for (const auto& [command, uses] : std::exchange(commands_, {}))
    add_common_options(*command, uses);
  const int code = caught_run(argc, argv);
  errno = 0;
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  int error = errno;
  // An earlier flush that failed kept no reason; writing one more byte fails for the same one.
  if (error == 0 && write(STDOUT_FILENO, "\n", 1) < 0) error = errno;
  say_error(name_, std::string("stdout cannot be written") +
                       (error != 0 ? ": " + std::generic_category().message(error) : ""));
  return kExitFailure;
}

int Program::caught_run(int argc, char** argv) {
  try {
    return guarded_run(argc, argv);
  } catch (const NothingToMeasure& error) {
    say_error(name_, error.what());
    return kExitNothingToMeasure;
  } catch (const InputError& error) {
    say_error(name_, error.what());
    return kExitBadInput;
  } catch (const std::bad_alloc&) {
    say_error(name_, "there is not enough memory for this input");
    return kExitFailure;
  } catch (const std::exception& error) {
    say_error(name_, error.what());
    return kExitFailure;
  }
}

int Program::guarded_run(int argc, char** argv) {
  try {
    app_.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      app_.exit(error);
      return 0;
    }
    say_error(name_, usage_error(error, {argv + std::min(argc, 1), argv + argc}));
    return kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    throw_as_ours(error);
  }
}

std::string Program::usage_error(const CLI::ParseError& error,
                                 const std::vector<std::string>& arguments) const {
  const std::string first = arguments.empty() ? "" : arguments.front();
  const std::vector<std::string> commands = names_of(app_, false);
  const bool known = contains(commands, first);
  const std::string help = "; " + name_ + (known ? " " + first : "") + " --help tells more";
  if (!known && !first.empty() && !first.starts_with('-')) {
    const auto meant = nearest_name(first, commands);
    return "\"" + first + "\" is no command; " +
           (meant ? "did you mean " + *meant + "?" : "there are " + joined(commands, ", ") + help);
  }
  if (known) {
    const std::vector<std::string> options = names_of(*app_.get_subcommand(first), true);
    for (const std::string& argument : arguments) {
      const std::string given = argument.substr(0, argument.find('='));
      if (!given.starts_with("--") || contains(options, given)) continue;
      if (const auto meant = nearest_name(given, options))
        return "there is no option " + given + "; did you mean " + *meant + "?";
    }
  }
  return plain_words(error.what()) + help;
}

void Program::say(const std::string& line) const {
  if (!common_.json && common_.verbosity >= 0) std::cout << printable(line) << '\n';
}

void Program::log(const std::string& line) const {
  if (common_.verbosity >= 0 && isatty(STDERR_FILENO) == 0) std::cerr << printable(line) << '\n';
}

void Program::result(const nlohmann::json& document) const {
  if (common_.json) std::cout << json_lines(document);
}

void Program::announce(const std::string& line) const {
  if (!common_.json && common_.verbosity >= 0)
    std::cerr << (isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "") << line << '\n';
}

ProgressReport Program::progress(const std::string& label) const {
  if (common_.json || common_.verbosity < 0) return {};
  return
      [display = std::make_shared<ProgressDisplay>(label)](double share) { display->show(share); };
}

}  // namespace plotscan
