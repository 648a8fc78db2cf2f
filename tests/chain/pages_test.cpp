// SPDX-License-Identifier: Apache-2.0
// What is installed beside the programs, made from their declarations: manual pages, completion.
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>

#include "programs.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using testing::TemporaryFolder;

std::set<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
    found.insert((*i)[1]);
  return found;
}

// The command by which a shell prints what it offers at the end of each line, and then a dot.
std::string completing(const std::string& shell, const std::vector<std::string>& lines) {
  const std::string program = lines.at(0).substr(0, lines.at(0).find(' '));
  std::string bash = "source <(" + program +
                     " --print-bash-completion); offer() { COMPREPLY=() COMP_WORDS=(\"$@\") "
                     "COMP_CWORD=$(($# - 1)); _" +
                     program + "; printf \"%s\\n\" \"${COMPREPLY[@]}\" .; }";
  std::string zsh = PLOTSCAN_SOURCE_DIR "/tests/chain/zsh_offers";
  std::string fish = program + " --print-fish-completion | source";
  for (const std::string& line : lines) {
    bash += "; offer " + line + (line.ends_with(' ') ? "\"\"" : "");
    zsh += " '" + line + "'";
    fish += "; complete -C \"" + line + "\" | cut -f 1; echo .";
  }
  if (shell == "bash") return "bash -c '" + bash + "'";
  return shell == "zsh" ? zsh : "HOME=$PWD fish --no-config -c '" + fish + "'";
}

// A program's pages, in a folder that holds one file, "cloud.las".
class Pages : public ::testing::TestWithParam<const char*> {
 protected:
  Pages() { std::ofstream(folder_.path() / "cloud.las"); }

  std::string output_of(const std::string& command) {
    const auto finished = testing::run(command, folder_.path().string());
    EXPECT_EQ(finished.exit_code, 0) << command << '\n' << finished.errors;
    EXPECT_EQ(finished.errors, "") << command;
    return finished.output;
  }
  // The source of the program's manual page, with its hyphens as they are read.
  std::string manual() {
    return std::regex_replace(output_of(std::string(GetParam()) + " --print-manual"),
                              std::regex(R"(\\-)"), "-");
  }
  // What bash, zsh or fish offers at the end of each of some command lines of one program.
  std::vector<std::set<std::string>> offered(const std::string& shell,
                                             const std::vector<std::string>& lines) {
    std::istringstream output(output_of(completing(shell, lines)));
    std::vector<std::set<std::string>> offers(1);
    for (std::string word; output >> word;)
      if (word == ".") {
        offers.emplace_back();
      } else {
        offers.back().insert(word);
      }
    offers.pop_back();
    return offers;
  }
  std::set<std::string> offered(const std::string& shell, const std::string& line) {
    return offered(shell, std::vector{line}).at(0);
  }
  std::set<std::string> commands() {
    const std::string help = output_of(std::string(GetParam()) + " --help");
    return matches(help.substr(help.find("Subcommands:")), "\n  (\\w+)");
  }
  std::set<std::string> long_flags(const std::string& command) {
    const std::string help = output_of(std::string(GetParam()) + " " + command + " --help");
    return matches(help, "\n  (?:-\\w,)?(--[\\w-]+)");
  }

  TemporaryFolder folder_;
};

TEST_P(Pages, TellEveryOptionOfEveryCommand) {
  const std::string page = manual();
  ASSERT_FALSE(commands().empty());
  for (const std::string& command : commands()) {
    ASSERT_THAT(page, HasSubstr("\n.SS " + command + "\n"));
    const std::string section = page.substr(page.find("\n.SS " + command + "\n"));
    ASSERT_GE(long_flags(command).size(), 5u) << command;
    for (const std::string& flag : long_flags(command))
      EXPECT_THAT(section.substr(0, section.find("\n.S", 1)), HasSubstr(flag));
  }
}

// What --help says in brackets, without its line breaks, is in the manual.
TEST_P(Pages, TellRangesDefaultsAndExclusionsAsHelpDoes) {
  const std::string program = GetParam();
  const std::string page = manual();
  for (const std::string& command : commands()) {
    const std::string help =
        std::regex_replace(output_of(program + " " + command + " --help"), std::regex("\\s+"), " ");
    const std::regex notes(R"(\[(?:required|default: |only with|not with|[-+0-9.e]+ to )[^\]]*\])");
    for (std::sregex_iterator at(help.begin(), help.end(), notes), end; at != end; ++at)
      EXPECT_THAT(page, HasSubstr(at->str())) << command;
  }
}

TEST_P(Pages, CompleteEveryCommandAndOptionInEveryShell) {
  const std::string program = GetParam();
  std::vector<std::string> lines = {program + " "};
  std::vector<std::set<std::string>> complete = {commands()};
  for (const std::string& command : commands()) {
    lines.push_back(program + " " + command + " --");
    complete.push_back(long_flags(command));
  }
  for (const char* shell : {"bash", "zsh", "fish"}) {
    SCOPED_TRACE(shell);
    const auto offers = offered(shell, lines);
    ASSERT_EQ(offers.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      EXPECT_THAT(offers[i], IsSupersetOf(complete[i])) << lines[i];
  }
}

TEST_P(Pages, AreSoundRoff) {
  const std::string program = GetParam();
  const auto checked =
      testing::run(program + " --print-manual | groff -man -Tutf8 -ww -z", folder_.path().string());
  EXPECT_EQ(checked.output + checked.errors, "");
}

INSTANTIATE_TEST_SUITE_P(OfEveryProgram, Pages,
                         ::testing::Values("farmgen", "lidarsim", "estimator", "farmbench",
                                           "plotview"),
                         [](const auto& name) { return std::string(name.param); });

using Completion = Pages;

TEST_P(Completion, NamesTheChoicesOfAnOption) {
  EXPECT_THAT(offered(GetParam(), "estimator run --method "), ElementsAre("dhami2020", "lattice"));
  EXPECT_THAT(offered(GetParam(), "estimator run --method d"), ElementsAre("dhami2020"));
}

TEST_P(Completion, TakesAFolderForNoCommand) {
  EXPECT_THAT(offered(GetParam(), "estimator score run --m"), ElementsAre("--min-iou"));
}

INSTANTIATE_TEST_SUITE_P(InEveryShell, Completion, ::testing::Values("bash", "zsh", "fish"),
                         [](const auto& name) { return std::string(name.param); });

using FileCompletion = Pages;

TEST_P(FileCompletion, IsForAllButNumbers) {
  EXPECT_THAT(offered(GetParam(), "estimator run c"), ElementsAre("cloud.las"));
  EXPECT_THAT(offered(GetParam(), "estimator run --boxes c"), ElementsAre("cloud.las"));
  EXPECT_THAT(offered(GetParam(), "estimator run --seed c"), IsEmpty());
}

// bash itself completes files where a completion offers nothing.
INSTANTIATE_TEST_SUITE_P(InShellsThatAreTold, FileCompletion, ::testing::Values("zsh", "fish"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace plotscan
