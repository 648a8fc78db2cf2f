// SPDX-License-Identifier: Apache-2.0
#include "core/contains.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(Contains, FindsAValueAmongItems) {
  constexpr const char* kNames[] = {"wheat", "maize"};
  EXPECT_TRUE(contains(kNames, std::string("maize")));
  EXPECT_FALSE(contains(kNames, std::string("soybean")));
  EXPECT_FALSE(contains(std::vector<int>{}, 0));
}

TEST(Contains, FindsAMembersValue) {
  const std::vector<std::pair<std::string, int>> lengths = {{"wheat", 5}, {"soybean", 7}};
  EXPECT_TRUE(contains(lengths, 7, &std::pair<std::string, int>::second));
  EXPECT_FALSE(contains(lengths, 6, &std::pair<std::string, int>::second));
}

}  // namespace
}  // namespace plotscan
