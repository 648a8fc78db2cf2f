// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/blind_suite.h"
#include "core/error.h"
#include "farmbench/command_method.h"
#include "farmbench/entry/command_line.h"
#include "farmbench/methods.h"
#include "farmbench/run.h"
#include "scan/cloud_writer.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using plotscan::testing::write_blind_suite;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CommandLine, IsSplitFirstAndFilledInAfterwards) {
  EXPECT_THAT(split_command("tool  {cloud} 'a b' \"c'd\" x\"y z\"w ''"),
              ElementsAre("tool", "{cloud}", "a b", "c'd", "xy zw", ""));
  const std::map<std::string, std::string> values = {{"cloud", "/a b/it's \"{out}\" $(x).pcd"},
                                                     {"out", "o"}};
  EXPECT_THAT(substituted({"--in={cloud}", "{{x}", "{out}{out}"}, values),
              ElementsAre("--in=/a b/it's \"{out}\" $(x).pcd", "{x}", "oo"));
  EXPECT_THAT(message_of<InputError>([] { split_command("tool 'a b"); }), HasSubstr("no end"));
  EXPECT_THAT(message_of<InputError>([] { split_command(" \n"); }), HasSubstr("no program"));
  for (const char* word : {"{clod}", "{", "{cloud"})
    EXPECT_THAT(message_of<InputError>([&] { substituted({word}, values); }),
                HasSubstr("names none of {cloud}, {out}"));
}

// Whether any process has this command line.
bool lives(const std::string& command) {
  for (const auto& process : fs::directory_iterator("/proc")) {
    std::ifstream in(process.path() / "cmdline");
    std::string line;
    std::getline(in, line);
    std::ranges::replace(line, '\0', ' ');
    if (line.starts_with(command)) return true;
  }
  return false;
}

// A field of one box and three points, as run_farm hands it on, in a folder whose name would mean
// much to a shell.
class Command : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path scan = folder_.path() / "it's a \"field\" $(touch x)" / "scan";
    fs::create_directories(scan);
    cloud_ = scan / "cloud.pcd";
    poses_ = scan / "poses.csv";
    folder_.write(fs::relative(poses_, folder_.path()), "t_s\n");
    scan::PcdWriter writer(cloud_);
    writer.write(std::vector<scan::LabelledPoint>{
        {.x = 1, .y = 2, .z = 3, .label = scan::PointClass::crop, .plot = 77, .plant = 78}});
    writer.close();
  }

  MethodRun run_command(const std::string& command, const ProcessLimits& limits = {}) {
    CommandMethod method{.name = "mine",
                         .command = command,
                         .words = split_command(command),
                         .limits = limits,
                         .suite_folder = folder_.path()};
    FoundFields found(cloud_);
    return run_command_method(method, {.cloud = cloud_,
                                       .poses = poses_,
                                       .map = map_,
                                       .plots = plots_,
                                       .terrain = terrain_,
                                       .found = found,
                                       .threads = 3});
  }

  TemporaryFolder folder_;
  fs::path cloud_;
  fs::path poses_;
  cloud::CloudMap map_{cloud::Area{-1, -1, 1, 1}};
  std::vector<score::TruePlot> plots_ = {
      {.id = 5, .box = {.center = {1, 2}, .width_m = 1, .length_m = 4}}};
  terrain::Terrain terrain_{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
};

TEST_F(Command, GetsWhatItNamesAndHandsInWhatItWrites) {
  folder_.write(
      "tool.sh",
      "test $# = 5 || exit 9\n"
      "grep -q 'return_count$' \"$1\" || exit 8\n"  // the last of its fields: no labels
      "test \"$2\" = 3 || exit 7\n"
      "head -1 \"$3\" | grep -q t_s || exit 6\n"
      "sed 's/heading_deg/height_p99_m/; s/,0$/,0.75/' \"$4\" | cut -d, -f1,6 > \"$5\"\n");
  const MethodRun run =
      run_command("sh {suite}/tool.sh {cloud} {threads} {poses} {boxes_csv} {out_csv}");
  EXPECT_EQ(run.result.failure, "");
  ASSERT_EQ(run.estimate.plots.size(), 1U);
  EXPECT_EQ(run.estimate.plots[0].id.text(), "5");
  EXPECT_EQ(run.estimate.plots[0].box.center, Eigen::Vector2d(1, 2));
  EXPECT_EQ(run.estimate.plots[0].heights_m.at("p99"), 0.75);
  EXPECT_GT(run.result.seconds, 0);
  EXPECT_GT(run.result.peak_memory_mb, 0.1);
  EXPECT_FALSE(fs::exists("x"));
  const auto entries = fs::directory_iterator(folder_.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 2);  // its folder is gone
}

// A long PATH, none of whose first places has the program, keeps the child from becoming it.
TEST_F(Command, TheMemoryOfThisProgramIsNotTheirs) {
  const std::vector<char> own(std::size_t{300} << 20, 'x');
  const std::string path = getenv("PATH");
  std::string long_path;
  for (int i = 0; i < 40000; ++i) long_path += "/:";
  setenv("PATH", (long_path + path).c_str(), 1);
  const MethodRun run = run_command("true {out}");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(own.back(), 'x');
  EXPECT_EQ(run.result.failure, "wrote no output");
  EXPECT_LT(run.result.peak_memory_mb, 100);
}

TEST_F(Command, FailuresAreResults) {
  EXPECT_EQ(run_command("sh -c 'echo one; echo \"no ground\" >&2; exit 4' {out}").result.failure,
            "ended with exit code 4: no ground");
  EXPECT_THAT(run_command("sh -c 'kill -SEGV $$' {out}").result.failure,
              HasSubstr("Segmentation fault"));
  EXPECT_THAT(run_command("no-such-program-here {out}").result.failure,
              HasSubstr("is there a program no-such-program-here?"));
  EXPECT_EQ(run_command("true {out}").result.failure, "wrote no output");
  EXPECT_THAT(run_command("sh -c 'echo height_p99_m >$0; echo tall >>$0' {out_csv}").result.failure,
              ::testing::AllOf(HasSubstr("plots.csv:2: height_p99_m is \"tall\""),
                               HasSubstr("has neither a box nor")));
}

// The message goes into JSON, which is UTF-8, and onto terminals; the log may be large.
TEST_F(Command, WhateverItWritesItsLastLineIsText) {
  EXPECT_EQ(run_command("sh -c 'printf \"10 %%\\r20 %%\\rgr\\374n \\033[31mred\\n\"; exit 4' {out}")
                .result.failure,
            "ended with exit code 4: gr\\xfcn \\x1b[31mred");
  const std::string accents =
      run_command(
          "sh -c 'printf x; for i in $(seq 200); do printf \"\\303\\244\"; done; exit 4' {out}")
          .result.failure;
  EXPECT_TRUE(accents.ends_with("\u00e4")) << accents;
  EXPECT_EQ(
      run_command("sh -c 'head -c 100000 /dev/zero | tr \"\\000\" a; echo; echo end; exit 4' {out}")
          .result.failure,
      "ended with exit code 4: end");
  EXPECT_EQ(run_command("sh -c 'test -z \"$(ls -A)\" || exit 5; echo mine >log.txt; exit 4' {out}")
                .result.failure,
            "ended with exit code 4");
}

TEST_F(Command, IsStoppedWhereItsTimeIsOver) {
  const auto start = std::chrono::steady_clock::now();
  // A grandchild that would go on, holding the log open.
  const MethodRun run =
      run_command("sh -c 'sleep 987 & echo waiting; wait' {out}", {.seconds = 0.3});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(run.result.failure, "took more than 0.3 s and was stopped: waiting");
  EXPECT_LT(took.count(), 100);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (lives("sleep 987") && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // the killed take a moment to go
  EXPECT_FALSE(lives("sleep 987"));
}

TEST_F(Command, IsStoppedWhereItsOutputWouldFillTheDisk) {
  EXPECT_THAT(run_command("sh -c 'yes on and on' {out}", {.seconds = 60, .log_bytes = 1'000'000})
                  .result.failure,
              ::testing::StartsWith("printed more than 1 MB and was stopped: "));
}

TEST_F(Command, IsKeptWithinItsMemory) {
  EXPECT_EQ(run_command("sh -c 'x=$(head -c 60000000 /dev/zero | tr \"\\\\000\" a); exit 3' {out}",
                        {.memory_bytes = std::uint64_t{4} << 30})
                .result.failure,
            "ended with exit code 3");
  EXPECT_NE(run_command("sh -c 'x=$(head -c 60000000 /dev/zero | tr \"\\\\000\" a); exit 3' {out}",
                        {.memory_bytes = std::uint64_t{40} << 20})
                .result.failure,
            "ended with exit code 3");
}

TEST(CommandSuite, RunsBesideOurOwnAndStaysInTheReports) {
  const TemporaryFolder folder;
  folder.write("mine.sh",
               "echo plot_number,height_p99_m > \"$2\"\n"
               "tail -n +2 \"$1\" | cut -d, -f1 | sed 's/$/,0.8/' >> \"$2\"\n");
  const fs::path suite = write_blind_suite(folder);
  std::string text = read_text(suite);
  text.replace(text.find("methods: [lattice]"), std::string::npos,
               "methods:\n  - one-number\n"
               "  - {name: mine, command: 'sh {suite}/mine.sh {boxes_csv} {out_csv}'}\n"
               "  - {name: broken, command: 'sh -c \"exit 3\" {out}', seconds: 10}\n");
  const RunOptions options{.suite = folder.write("entered.yaml", text),
                           .output = folder.path() / "results",
                           .build = "test"};
  const RunSummary summary = run(options);
  const auto row = std::ranges::find_if(summary.table, [](const TableRow& candidate) {
    return candidate.method == "mine/p99 true-boxes" && candidate.truth == "height_p99_m";
  });
  ASSERT_NE(row, summary.table.end());
  EXPECT_EQ(row->boxes.found, 4U);
  EXPECT_THAT(read_text(options.output / "leaderboard.md"),
              ::testing::AllOf(HasSubstr("mine/p99 true-boxes"),
                               HasSubstr("- broken, zq-even-hidden: 1 of 1 farm, ended with exit "
                                         "code 3")));
  const std::string table = read_text(options.output / "table.csv");
  report(options.output, 1);
  EXPECT_EQ(read_text(options.output / "table.csv"), table);
  EXPECT_EQ(run(options).resumed, 2U);
  folder.write("mine.sh", "exit 1\n");  // another program: its farms are run again
  EXPECT_EQ(run(options).resumed, 0U);
}

TEST(CommandMethod, IsMadeOfTheFilesThatItNamesAndOfNoOthers) {
  const TemporaryFolder folder;
  folder.write("mine.sh", "exit 1\n");
  const auto files = [&](const std::string& command, const fs::path& suite) {
    return made_from(command_method("mine=" + command, suite))["sha256"];
  };
  const std::string tool = (folder.path() / "mine.sh").string();
  EXPECT_TRUE(files("no-such-program {suite}/mine.sh {out}", folder.path() / "a/.././s.yaml")
                  .contains(tool));
  // It runs in a folder of its own: files of this one are none of its.
  const fs::path here = fs::current_path();
  fs::current_path(folder.path());
  folder.write("cloud.pcd", "");
  EXPECT_EQ(files("no-such-program {cloud} mine.sh {out}", "s.yaml"), nlohmann::json::object());
  EXPECT_TRUE(files("no-such-program {suite}/mine.sh {out}", "./s.yaml").contains(tool));
  fs::current_path(here);
  EXPECT_EQ(files("no-such-program '" + std::string(5000, 'x') + "' {out}", "s.yaml"),
            nlohmann::json::object());
}

TEST(CommandSuite, NamesWhatIsWrongWithACommand) {
  const TemporaryFolder folder;
  const std::string suite = read_text(write_blind_suite(folder));
  const auto refused = [&](const std::string& entry) {
    std::string text = suite;
    text.replace(text.find("methods: [lattice]"), std::string::npos, "methods: [" + entry + "]\n");
    const fs::path file = folder.write("bad.yaml", text);
    return message_of<InputError>([&] { load_suite(file); });
  };
  EXPECT_THAT(refused("{name: mine, command: 'tool {cloud}'}"), HasSubstr("names no output"));
  EXPECT_THAT(refused("{name: mine, command: 'tool {out} {out_csv}'}"),
              HasSubstr("names two outputs; it must name one"));
  EXPECT_THAT(refused("{name: mine, command: 'tool {clod} {out}'}"), HasSubstr("names none of"));
  EXPECT_THAT(refused("{name: mine, command: './tool {out}'}"), HasSubstr("write {suite}/./tool"));
  EXPECT_THAT(refused("{name: 'a b', command: 'tool {out}'}"), HasSubstr("is not a name"));
  EXPECT_THAT(refused("{name: lattice, command: 'tool {out}'}"), HasSubstr("one of Plotscan's"));
  EXPECT_THAT(refused("{name: mine, command: 'tool {out}', second: 3}"), HasSubstr("second"));
}

}  // namespace
}  // namespace plotscan::farmbench
