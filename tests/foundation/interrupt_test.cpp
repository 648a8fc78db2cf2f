// SPDX-License-Identifier: Apache-2.0
#include "core/internal/interrupt.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/temporary_path.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;

// A program of four threads that write into an unfinished folder, and make it where it is missing,
// for as long as they run.
[[noreturn]] void write_for_ever(const fs::path& folder, int ready) {
  remove_unfinished_work_on_interrupt();
  const TemporaryPath unfinished(folder);
  const auto write_files = [&](int thread) {
    for (int i = 0;; ++i) {
      const fs::path place = folder / std::to_string(thread) / std::to_string(i % 50);
      std::error_code ignored;
      fs::create_directories(place, ignored);
      std::ofstream(place / "file") << std::string(static_cast<std::size_t>(i % 5000), 'x');
    }
  };
  for (int thread = 1; thread < 4; ++thread) std::thread(write_files, thread).detach();
  [[maybe_unused]] const ssize_t told = write(ready, "x", 1);
  write_files(0);
  _exit(0);
}

TEST(Interrupt, LeavesNothingWhileOtherThreadsWrite) {
  const testing::TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t process = fork();
    if (process == 0) write_for_ever(folder.path() / ".out.partial", ends[1]);
    char told = 0;
    ASSERT_EQ(read(ends[0], &told, 1), 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 2 * i));
    kill(process, i % 2 == 0 ? SIGINT : SIGTERM);
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + (i % 2 == 0 ? SIGINT : SIGTERM));
    EXPECT_TRUE(fs::is_empty(folder.path())) << "interrupt " << i;
    close(ends[0]);
    close(ends[1]);
  }
}

}  // namespace
}  // namespace plotscan
