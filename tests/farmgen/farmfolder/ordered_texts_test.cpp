// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/ordered_texts.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace plotscan::farmfolder {
namespace {

// Every third text takes longer than the next ones.
std::string slow_text(std::size_t number) {
  if (number % 3 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return std::to_string(number);
}

TEST(MakeInOrder, HandsTextsOnByTheirNumbers) {
  for (const int threads : {1, 2, 9}) {
    std::string joined, expected;
    for (int i = 0; i < 50; ++i) expected += std::to_string(i);
    std::size_t next = 0;
    make_in_order(50, threads, slow_text, [&](std::size_t number, const std::string& text) {
      EXPECT_EQ(number, next++);
      joined += text;
    });
    EXPECT_EQ(joined, expected) << threads;
  }
}

TEST(MakeInOrder, CallsNothingForNoTexts) {
  make_in_order(0, 2, slow_text, [](std::size_t, const std::string&) { ADD_FAILURE(); });
}

TEST(MakeInOrder, ThrowsWhatIsThrown) {
  const auto take = [](std::size_t number, const std::string&) {
    if (number == 7) throw std::runtime_error("full");
  };
  EXPECT_THROW(make_in_order(50, 2, slow_text, take), std::runtime_error);
}

}  // namespace
}  // namespace plotscan::farmfolder
