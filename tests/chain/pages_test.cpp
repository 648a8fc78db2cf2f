// SPDX-License-Identifier: Apache-2.0
// What is installed beside the programs, made from their declarations: manual pages, completion.
#include <regex>
#include <set>

#include "programs.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>

namespace plotscan {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using testing::TemporaryFolder;

std::set<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
    found.insert((*i)[1]);
  return found;
}

class Pages : public ::testing::TestWithParam<const char*> {
 protected:
  std::string output_of(const std::string& command) {
    const auto finished = testing::run(command, folder_.path().string());
    EXPECT_EQ(finished.exit_code, 0) << command << '\n' << finished.errors;
    EXPECT_EQ(finished.errors, "") << command;
    return finished.output;
  }
  // What bash offers for the last of the words.
  std::set<std::string> completed(const std::string& words, int last) {
    const std::string program = GetParam();
    return matches(
        output_of("bash -c 'source <(" + program + " --print-bash-completion); COMP_WORDS=(" +
                  words + "); COMP_CWORD=" + std::to_string(last) + "; _" + program +
                  "; printf \"%s\\n\" \"${COMPREPLY[@]}\"'"),
        "(\\S+)");
  }
  std::set<std::string> commands() {
    const std::string help = output_of(std::string(GetParam()) + " --help");
    return matches(help.substr(help.find("Subcommands:")), "\n  (\\w+)");
  }

  TemporaryFolder folder_;
};

TEST_P(Pages, HaveEveryOptionOfEveryCommand) {
  const std::string program = GetParam();
  std::string manual = output_of(program + " --print-manual");
  manual = std::regex_replace(manual, std::regex(R"(\\-)"), "-");
  ASSERT_FALSE(commands().empty());
  EXPECT_THAT(completed(program + " \"\"", 1), IsSupersetOf(commands()));
  for (const std::string& command : commands()) {
    EXPECT_THAT(manual, HasSubstr("\n.SS " + command + "\n"));
    const std::string section = manual.substr(manual.find("\n.SS " + command + "\n"));
    const auto flags =
        matches(output_of(program + " " + command + " --help"), "\n  (?:-\\w,)?(--[\\w-]+)");
    ASSERT_GE(flags.size(), 5u) << command;
    for (const std::string& flag : flags)
      EXPECT_THAT(section.substr(0, section.find("\n.S", 1)), HasSubstr(flag));
    EXPECT_THAT(completed(program + " " + command + " -", 2), IsSupersetOf(flags));
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

TEST(Completion, NamesTheChoicesOfAnOption) {
  const TemporaryFolder folder;
  const auto finished = testing::run(
      "bash -c 'source <(estimator --print-bash-completion); COMP_WORDS=(estimator run --method "
      "d); COMP_CWORD=3; "
      "_estimator; echo \"${COMPREPLY[@]}\"'",
      folder.path().string());
  EXPECT_EQ(finished.output, "dhami2020\n") << finished.errors;
}

}  // namespace
}  // namespace plotscan
