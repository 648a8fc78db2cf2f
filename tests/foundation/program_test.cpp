// SPDX-License-Identifier: Apache-2.0
#include "core/program.h"

#include <array>
#include <new>

#include <gtest/gtest.h>
#include <unistd.h>

namespace plotscan {
namespace {

[[noreturn]] void run_without_memory() {
  Program program("tool", "a program");
  program.command("work", "a command", [] { throw std::bad_alloc(); });
  std::array<char, 5> name{"tool"};
  std::array<char, 5> command{"work"};
  std::array<char*, 2> arguments{name.data(), command.data()};
  _exit(program.run(2, arguments.data()));
}

TEST(ProgramDeathTest, MemoryThatDoesNotSufficeIsOneMessage) {
  EXPECT_EXIT(run_without_memory(), ::testing::ExitedWithCode(1),
              "^tool: there is not enough memory for this input\n$");
}

}  // namespace
}  // namespace plotscan
