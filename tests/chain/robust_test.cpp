// SPDX-License-Identifier: Apache-2.0
// What programs do where the world around them fails: no space, no reader, a kill.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "programs.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;
using testing::Finished;
using ::testing::HasSubstr;
using testing::kFourPlots;
using testing::kSmokeSuite;
using testing::run;
using ::testing::StartsWith;
using testing::TemporaryFolder;

class Robust : public ::testing::Test {
 protected:
  Finished run_here(const std::string& command) const {
    return run(command, folder_.path().string());
  }
  void succeed(const std::string& command) const {
    const Finished finished = run_here(command);
    ASSERT_EQ(finished.exit_code, 0) << command << finished.errors;
  }
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(Robust, VerboseTellsStagesAndQuietSaysNothing) {
  const std::string generate = "farmgen generate " + kFourPlots;
  EXPECT_THAT(run_here(generate + " -o told -v").errors, HasSubstr("farmgen: canopies"));
  const Finished quiet = run_here(generate + " -o quiet -q");
  EXPECT_EQ(quiet.output + quiet.errors, "");
}

TEST_F(Robust, AFullStdoutIsAFailure) {
  succeed("farmgen generate " + kFourPlots + " -o farm");
  for (const std::string command :
       {"farmgen info farm", "farmgen info farm --json", "farmgen --help", "farmgen --version",
        "lidarsim sensors", "estimator --version", "farmbench --help", "plotview --help"}) {
    const Finished finished = run_here(command + " >/dev/full");
    EXPECT_EQ(finished.exit_code, 1) << command;
    EXPECT_THAT(finished.errors, HasSubstr("stdout cannot be written: No space left on device"))
        << command;
  }
}

// A limit on the size of files stands for a full disk: both end a write in its midst.
TEST_F(Robust, AFullDiskIsSaidAndNothingIsLeft) {
  succeed("farmgen generate " + kFourPlots + " -o farm");
  succeed("lidarsim fly farm -o scan --speed 4");
  const auto before = entries();
  for (const std::string& command :
       {"farmgen generate " + kFourPlots + " -o out",
        std::string("farmgen export farm --gazebo sim -o out"),
        std::string("lidarsim fly farm -o out --speed 4"),
        std::string("lidarsim convert scan out.las"), std::string("lidarsim convert scan out.bag"),
        std::string("estimator run scan -o out"), "farmbench run " + kSmokeSuite + " -o out"}) {
    const Finished finished = run_here("ulimit -f 8; " + command);
    EXPECT_EQ(finished.exit_code, 1) << command << finished.errors;
    EXPECT_THAT(finished.errors, HasSubstr("no space left on ")) << command;
    EXPECT_EQ(entries(), before) << command;
  }
}

TEST_F(Robust, MistypedCommandsAndOptionsAreGuessed) {
  EXPECT_EQ(run_here("farmgen genrate").errors,
            "farmgen: \"genrate\" is no command; did you mean generate?\n");
  EXPECT_EQ(run_here("estimator run x --crop-bx 1,2,3,4 -o y").errors,
            "estimator: there is no option --crop-bx; did you mean --crop-box?\n");
  for (const std::string command : {"farmgen", "farmgen check", "lidarsim fly -j x", "plotview x"})
    EXPECT_TRUE(run_here(command).errors.starts_with(command.substr(0, command.find(' ')) + ": "))
        << command;
}

TEST_F(Robust, ASeedThatIsTooLargeIsRefused) {
  for (const std::string seed : {"18446744073709551616", "12345678901234567890123", "0x10", "''"}) {
    const Finished finished = run_here("farmgen check " + kFourPlots + " --seed " + seed);
    EXPECT_EQ(finished.exit_code, 2) << seed;
    EXPECT_THAT(finished.errors, HasSubstr("[0, 18446744073709551615]")) << seed;
  }
  EXPECT_EQ(run_here("farmgen check " + kFourPlots + " --seed 18446744073709551615").exit_code, 0);
}

TEST_F(Robust, EscapesAndForeignBytesInNamesAreShownEscaped) {
  const Finished absent = run_here("farmgen check \"$(printf 'a\\033[31m\\377')\"");
  EXPECT_THAT(absent.errors, StartsWith("farmgen: a\\x1b[31m\\xff: no such file, and none of"));
  // A name that is no UTF-8 does not end in an exception of JSON.
  const Finished made =
      run_here("farmgen generate " + kFourPlots + " -o \"$(printf 'f\\344')\" --json");
  EXPECT_EQ(made.exit_code, 0) << made.errors;
  EXPECT_TRUE(nlohmann::json::accept(made.output)) << made.output;
}

TEST_F(Robust, ProgressOffATerminalIsALineNowAndThen) {
  succeed("farmgen generate " + kFourPlots + " -o farm");
  const Finished slow = run_here("timeout -s INT 12 lidarsim fly farm -o scan --speed 0.01 -j 1");
  EXPECT_THAT(slow.errors, ::testing::MatchesRegex("scanning +[0-9]+ %(, [0-9]+ s left)?\n"));
  EXPECT_EQ(run_here("lidarsim fly farm -o scan --speed 4 -q").errors, "");
}

TEST_F(Robust, AKilledSuiteIsResumedToTheSameBytes) {
  const auto bytes = [&](const std::string& name) {
    return read_text(folder_.path() / name / "results.json") +
           read_text(folder_.path() / name / "table.csv");
  };
  const auto start = std::chrono::steady_clock::now();
  succeed("farmbench run " + kSmokeSuite + " -o whole");
  const double whole_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const double share : {0.3, 0.6, 0.8}) {
    run_here("timeout -s KILL " + std::to_string(share * whole_s) + " farmbench run " +
             kSmokeSuite + " -o killed");
  }
  succeed("farmbench run " + kSmokeSuite + " -o killed --jobs 1");
  EXPECT_EQ(bytes("killed"), bytes("whole"));
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "killed"))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
}

TEST_F(Robust, ResultsThatWereEditedAreRefused) {
  succeed("farmbench run " + kSmokeSuite + " -o results --methods one-number");
  const fs::path file = folder_.path() / "results/results.json";
  const auto whole = nlohmann::json::parse(read_text(file));
  const auto refused = [&](const nlohmann::json& edited) {
    folder_.write("results/results.json", edited.dump());
    const Finished finished = run_here("farmbench report results");
    EXPECT_EQ(finished.exit_code, 2) << finished.errors;
    EXPECT_THAT(finished.errors,
                ::testing::AllOf(HasSubstr("results/results.json: "),
                                 ::testing::Not(HasSubstr("farmbench: internal"))));
  };
  auto other_method = whole;
  other_method["methods"] = {"witchcraft"};
  refused(other_method);
  auto no_score = whole;
  no_score["farms"][0]["methods"][0].erase("score");
  refused(no_score);
  refused(nlohmann::json::array({1, 2}));
}

}  // namespace
}  // namespace plotscan
