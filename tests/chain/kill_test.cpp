// SPDX-License-Identifier: Apache-2.0
// Every command that writes, killed, on a full disk, and where nothing may be written: its output
// is absent or whole, and whole when the command is run again. PLOTSCAN_KILLS says how many moments
// of a run are tried, 100 for a release.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include <gmock/gmock.h>

#include "writers.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using testing::Finished;
using ::testing::HasSubstr;
using testing::run;

int kills() {
  const char* stated = std::getenv("PLOTSCAN_KILLS");
  return stated == nullptr ? 4 : std::atoi(stated);
}

class Interrupted : public testing::Writing {
 protected:
  // Onto a disk of its own, mounted with these options; stdout is what lies on it afterwards.
  Finished write_on_disk(const std::string& options) const {
    folder_.write("write", "mkdir -p disk && mount -t tmpfs -o " + options +
                               " none disk || exit 9\n" + GetParam().command + " disk/" +
                               GetParam().output +
                               " >printed\ncode=$?\nfind disk -mindepth 1\nexit $code\n");
    return run("IN='" + input_.string() + "' unshare -m sh ./write", folder_.path());
  }
};

TEST_P(Interrupted, AKillLeavesNothingOrTheWhole) {
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(write().exit_code, 0);
  const double whole_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto whole = files();
  std::mt19937 moments(17);
  for (int kill = 0; kill < kills(); ++kill) {
    remove();
    const double after_s = std::uniform_real_distribution(0.0, whole_s)(moments);
    write("timeout -s KILL " + std::to_string(after_s));
    if (fs::exists(folder_.path() / GetParam().output)) {
      auto left = files();
      std::erase_if(left, [](const auto& file) { return file.first.starts_with("."); });
      EXPECT_EQ(left, whole) << "after " << after_s << " s";
    }
    if (kill % 4 == 3) {
      fs::remove_all(folder_.path() / GetParam().output);
      EXPECT_EQ(write().exit_code, 0);
      EXPECT_EQ(files(), whole) << "swept, and made again, after " << after_s << " s";
    }
  }
}

// A disk with room for a part of the output, then one that is read only.
TEST_P(Interrupted, ADiskThatIsFullOrClosedIsSaidAndNothingIsLeft) {
  if (run("unshare -m mount -t tmpfs none /mnt", folder_.path()).exit_code != 0)
    GTEST_SKIP() << "only root mounts a disk";
  ASSERT_EQ(write().exit_code, 0);
  std::uintmax_t bytes = 0;
  for (const auto& [name, text] : files()) bytes += text.size();
  remove();
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    // In pages; one is the folder's own.
    const auto pages = static_cast<int>(share * static_cast<double>(bytes) / 4096) + 1;
    const Finished full = write_on_disk("size=" + std::to_string(4 * pages) + "k");
    EXPECT_EQ(full.exit_code, 1) << share << full.errors;
    EXPECT_THAT(full.errors, HasSubstr("no space left on ")) << share;
    EXPECT_EQ(full.output, "") << share;
  }
  const Finished closed = write_on_disk("ro");
  EXPECT_THAT(closed.exit_code, AnyOf(1, 2)) << closed.errors;
  EXPECT_THAT(closed.errors, HasSubstr("Read-only file system"));
  EXPECT_EQ(closed.output, "");
}

INSTANTIATE_TEST_SUITE_P(Writers, Interrupted, testing::writers(),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace plotscan
