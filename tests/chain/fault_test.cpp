// SPDX-License-Identifier: Apache-2.0
// Every command that writes, on a disk that fails or interrupted at one of the calls by which it
// writes (faults.cpp), and with nobody who reads what it prints. PLOTSCAN_FAULTS says how many
// calls of a run are tried, 100 for a release.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>
#include <string>

#include <gmock/gmock.h>

#include "core/error.h"
#include "sanitized.h"
#include "writers.h"

namespace plotscan {
namespace {

using ::testing::AnyOf;
using ::testing::EndsWith;
using testing::Finished;
using ::testing::HasSubstr;
using testing::Writing;

constexpr int kInterrupt = 0;

int faults() {
  const char* stated = std::getenv("PLOTSCAN_FAULTS");
  return stated == nullptr ? 4 : std::atoi(stated);
}

class Faulted : public Writing {
 protected:
  void SetUp() override {
    if (testing::kSanitized) GTEST_SKIP() << "a sanitizer has to be loaded first";
  }

  Finished write_with_fault(long at, int error, const std::string& after = "") const {
    return write("FAULT_FOLDER='" + folder_.path().string() + "' FAULT_COUNT='" + count_file() +
                     "' FAULT_AT=" + std::to_string(at) + " FAULT_ERRNO=" + std::to_string(error) +
                     " LD_PRELOAD='" PLOTSCAN_FAULTS_LIBRARY "'",
                 after);
  }

  // The calls of the last run that came to its end.
  long counted() const { return std::stol(read_text(count_file())); }

  void TearDown() override { std::filesystem::remove(count_file()); }

 private:
  std::string count_file() const { return folder_.path().string() + ".count"; }
};

void expect_told(const Finished& finished, int error) {
  if (error == kInterrupt) {
    EXPECT_THAT(finished.exit_code, AnyOf(0, 130)) << finished.errors;
    return;
  }
  EXPECT_EQ(finished.exit_code, 1) << finished.errors;
  EXPECT_EQ(std::count(finished.errors.begin(), finished.errors.end(), '\n'), 1) << finished.errors;
  const bool full = error == ENOSPC || error == EDQUOT;
  EXPECT_THAT(finished.errors, HasSubstr(full ? "no space left on " : std::strerror(error)));
  // The output, or what is worked on beside it.
  EXPECT_THAT(finished.errors, AnyOf(HasSubstr("out"), HasSubstr("/.farmbench-export-")));
}

using Files = std::map<std::string, std::string>;

void expect_left(const Files& left, const Files& whole, bool replaced, int error) {
  if (replaced) {
    EXPECT_TRUE(left == whole);
  } else if (error != kInterrupt) {
    EXPECT_TRUE(left.empty()) << left.begin()->first;
  } else if (left.contains(Writing::GetParam().output)) {
    EXPECT_TRUE(left == whole);  // the interrupt came when all was done
  } else {
    // A mesh comes after its materials.
    EXPECT_TRUE(std::ranges::includes(whole, left)) << left.begin()->first;
  }
}

TEST_P(Faulted, ACallThatFailsIsSaidAndLeavesNothingOrTheWhole) {
  ASSERT_EQ(write_with_fault(0, 0).exit_code, 0);
  const long calls_anew = counted();
  const auto whole = files();
  ASSERT_EQ(write_with_fault(0, 0, "--force").exit_code, 0);
  const long calls_replacing = counted();
  ASSERT_GT(std::min(calls_anew, calls_replacing), 2);
  std::mt19937 chance(17);
  constexpr std::array kErrors = {ENOSPC, EIO, kInterrupt, EDQUOT, EROFS};
  for (int fault = 0; fault < faults(); ++fault) {
    const int error = kErrors.at(static_cast<std::size_t>(fault) % kErrors.size());
    const bool replaces = fault < faults() / 2;  // first, while there is something to replace
    const long calls = replaces ? calls_replacing : calls_anew;
    const long drawn = std::uniform_int_distribution(1L, calls)(chance);
    const long at = fault == 0 ? calls : fault == faults() - 1 ? 1 : drawn;
    SCOPED_TRACE("call " + std::to_string(at) + " of " + std::to_string(calls) + ": " +
                 (error == kInterrupt ? "interrupt" : std::strerror(error)) +
                 (replaces ? ", --force" : ""));
    if (!replaces) remove();
    expect_told(write_with_fault(at, error, replaces ? "--force" : ""), error);
    expect_left(files(), whole, replaces, error);
  }
  remove();
  ASSERT_EQ(write().exit_code, 0);
  EXPECT_TRUE(files() == whole);
}

TEST_P(Faulted, OutputIsWholeWhenNobodyReadsWhatIsPrinted) {
  ASSERT_EQ(write().exit_code, 0);
  const auto whole = files();
  remove();
  // The pipe has lost its reader before the command begins.
  const Finished unread = write("(sleep 0.1;", "--json; echo exit code $? >&2) | true");
  EXPECT_THAT(unread.errors, EndsWith("stdout cannot be written: Broken pipe\nexit code 1\n"));
  EXPECT_TRUE(files() == whole);
}

INSTANTIATE_TEST_SUITE_P(Writers, Faulted, testing::writers(),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace plotscan
