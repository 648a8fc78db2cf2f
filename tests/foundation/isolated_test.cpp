// SPDX-License-Identifier: Apache-2.0
#include "core/isolated.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/bytes.h"
#include "core/error.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using plotscan::testing::message_of;
using ::testing::HasSubstr;

std::string failure(const std::function<std::string()>& work, const IsolationLimits& limits = {}) {
  return message_of<InputError>([&] { run_isolated("x.dae: cannot be read", limits, work); });
}

TEST(Isolated, ReturnsWhatTheWorkReturns) {
  const std::string long_text(10'000'000, 'a');
  EXPECT_EQ(run_isolated("x", {}, [&] { return long_text; }), long_text);
  EXPECT_EQ(run_isolated("x", {}, [] { return std::string(); }), "");
}

TEST(Isolated, RunsInAnotherProcess) {
  int touched = 0;
  const std::string process = run_isolated("x", {}, [&] {
    touched = 1;
    return std::to_string(getpid());
  });
  EXPECT_EQ(touched, 0);
  EXPECT_NE(process, std::to_string(getpid()));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(Isolated, BadInputKeepsItsMessage) {
  EXPECT_EQ(failure([]() -> std::string { throw InputError("x.dae:3: is broken"); }),
            "x.dae:3: is broken");
}

TEST(Isolated, OtherFailuresAreTheReaders) {
  EXPECT_EQ(failure([]() -> std::string { throw std::runtime_error("odd"); }),
            "x.dae: cannot be read: its reader failed: odd");
  EXPECT_THAT(failure([]() -> std::string { throw std::bad_alloc(); }),
              HasSubstr("needs more than 1.1 GB of memory"));
  EXPECT_THAT(failure([]() -> std::string { _exit(0); }), HasSubstr("ended without a word"));
}

TEST(Isolated, ACrashIsOneMessage) {
  EXPECT_THAT(failure([]() -> std::string {
                std::signal(SIGSEGV, SIG_DFL);
                std::raise(SIGSEGV);
                return "";
              }),
              HasSubstr("x.dae: cannot be read: its reader crashed (Segmentation fault)"));
}

TEST(Isolated, WorkWithoutEndIsEnded) {
  EXPECT_THAT(failure(
                  []() -> std::string {
                    const volatile bool forever = true;
                    while (forever) {
                    }
                    return "";
                  },
                  {.processor_s = 1}),
              HasSubstr("takes more than 1 s"));
}

// What a child does that was forked while another thread held a lock.
TEST(Isolated, AChildThatHangsIsStartedAgain) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path starts = folder.path() / "starts";
  const auto hangs_at_first = [&](std::uintmax_t times) {
    return [&starts, times]() -> std::string {
      std::ofstream(starts, std::ios::app) << '.';
      while (std::filesystem::file_size(starts) <= times) pause();
      return "done";
    };
  };
  const IsolationLimits limits{.idle = std::chrono::milliseconds(200)};
  EXPECT_EQ(run_isolated("x", limits, hangs_at_first(2)), "done");
  EXPECT_EQ(std::filesystem::file_size(starts), 3);
}

TEST(Isolated, TheLastChildMayWaitForASlowDisk) {
  const auto work = [] {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return std::string("done");
  };
  EXPECT_EQ(run_isolated("x", {.idle = std::chrono::milliseconds(200)}, work), "done");
}

TEST(Isolated, WorkThatWaitsForeverIsEnded) {
  const auto work = []() -> std::string {
    for (;;) pause();
  };
  EXPECT_THAT(failure(work, {.processor_s = 0}), HasSubstr("came to no end"));
}

TEST(Isolated, MemoryIsLimited) {
  if (testing::kSanitized) GTEST_SKIP() << "sanitizers need addresses without end";
  const auto take = [](std::size_t bytes) {
    return [bytes] {
      const std::vector<char> taken(bytes, 'x');
      return std::string(1, taken[bytes / 2]);
    };
  };
  const IsolationLimits limits{.memory_bytes = 200'000'000};
  EXPECT_EQ(run_isolated("x", limits, take(100'000'000)), "x");
  EXPECT_THAT(failure(take(300'000'000), limits), HasSubstr("needs more than 0.2 GB"));
}

TEST(Isolated, ManyAtOnceDoNotMixTheirResults) {
  std::vector<std::thread> threads;
  std::vector<std::string> results(16);
  for (std::size_t i = 0; i < results.size(); ++i) {
    threads.emplace_back([&results, i] {
      results[i] =
          run_isolated("x", {}, [i] { return std::string(300'000, static_cast<char>('a' + i)); });
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i)
    EXPECT_EQ(results[i], std::string(300'000, static_cast<char>('a' + i)));
}

TEST(Bytes, ComeBackInTheirOrder) {
  ByteWriter writer;
  writer.put(7);
  writer.put_text("seven");
  writer.put_list(std::vector<float>{1, 2.5F});
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  EXPECT_EQ(reader.get<int>(), 7);
  EXPECT_EQ(reader.get_text(), "seven");
  EXPECT_EQ(reader.get_list<float>(), (std::vector<float>{1, 2.5F}));
  EXPECT_THROW(reader.get<char>(), std::runtime_error);
}

TEST(Bytes, AFieldIsCutOffOrFilledWithZeros) {
  ByteWriter writer;
  writer.put_field("seven", 3).put_field("seven", 7).put('!');
  EXPECT_EQ(writer.take(), std::string("sevseven\0\0!", 11));
}

TEST(Bytes, ACountBeyondTheBytesIsRefusedBeforeItIsAllocated) {
  ByteWriter writer;
  writer.put(std::uint64_t{1} << 62);
  const std::string bytes = writer.take();
  EXPECT_THROW(ByteReader(bytes).get_list<double>(), std::runtime_error);
}

}  // namespace
}  // namespace plotscan
