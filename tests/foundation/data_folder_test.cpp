// SPDX-License-Identifier: Apache-2.0
#include "core/data_folder.h"

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;

// A data folder with one suite, and an empty folder to work in.
class NamedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    suite_ = folder_.write("data/benchmarks/suites/paper.yaml", "name: paper\n");
    fs::create_directories(folder_.path() / "data/worlds");
    fs::create_directories(folder_.path() / "data/models");
    fs::create_directories(folder_.path() / "work");
    setenv("PLOTSCAN_DATA", (folder_.path() / "data").c_str(), 1);
    fs::current_path(folder_.path() / "work");
  }
  void TearDown() override {
    unsetenv("PLOTSCAN_DATA");
    fs::current_path(before_);
  }
  static fs::path found(const char* name) { return found_file(name, "benchmarks/suites"); }

  testing::TemporaryFolder folder_;
  fs::path before_ = fs::current_path();
  fs::path suite_;
};

TEST_F(NamedFile, IsTheShippedOneWhereThereIsNoneOfThatName) {
  EXPECT_EQ(found("paper"), suite_);
  EXPECT_EQ(found("paper.yaml"), suite_);
  EXPECT_EQ(found("wheat"), "wheat");
}

TEST_F(NamedFile, IsTheUsersOwnWhereThereIsOne) {
  folder_.write("work/paper", "name: mine\n");
  EXPECT_EQ(found("paper"), "paper");
}

// As after `farmbench run paper -o paper`.
TEST_F(NamedFile, IsNoFolder) {
  fs::create_directories("paper");
  EXPECT_EQ(found("paper"), suite_);
}

// As after `farmgen generate paper -o paper`: the farm is flown over.
TEST_F(NamedFile, MayBeAPlaceThatIsAFolder) {
  EXPECT_EQ(found_place("paper", "benchmarks/suites"), suite_);
  fs::create_directories("paper");
  EXPECT_EQ(found_place("paper", "benchmarks/suites"), "paper");
}

TEST_F(NamedFile, ThatBeginsWithADotIsTheUsers) {
  EXPECT_EQ(found("./paper"), "./paper");
  EXPECT_EQ(found("../paper"), "../paper");
}

// A mere name is that of something shipped; a path is opened, and says itself what is wrong.
TEST_F(NamedFile, ThatIsNoneIsToldWhatIsShipped) {
  const auto shipped = [](const char* name) { return found_or_shipped(name, "benchmarks/suites"); };
  EXPECT_EQ(shipped("paper"), suite_);
  EXPECT_THAT(testing::message_of<InputError>([&] { shipped("papre"); }),
              ::testing::HasSubstr("papre: no such file, and none of the shipped ones: paper"));
  for (const char* path : {"papre.yaml", "mine/papre"}) EXPECT_EQ(shipped(path), path);
}

}  // namespace
}  // namespace plotscan
