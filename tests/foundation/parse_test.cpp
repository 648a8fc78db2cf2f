// SPDX-License-Identifier: Apache-2.0
#include "core/parse.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(Parsed, TakesANumberThatIsTheWholeText) {
  EXPECT_EQ(parsed<int>("-12"), -12);
  EXPECT_EQ(parsed<std::uint64_t>("18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(parsed<double>("1.5e-3"), 0.0015);
}

TEST(Parsed, RefusesWhatIsNoNumberOrMoreThanOne) {
  for (const char* text : {"", " 1", "1 ", "1,2", "+1", "0x10", "one"}) {
    EXPECT_FALSE(parsed<int>(text)) << text;
    EXPECT_FALSE(parsed<double>(text)) << text;
  }
  EXPECT_FALSE(parsed<int>("1.5"));
}

TEST(Parsed, RefusesWhatTheTypeDoesNotHold) {
  EXPECT_FALSE(parsed<std::uint64_t>("18446744073709551616"));
  EXPECT_FALSE(parsed<std::uint8_t>("-1"));
  EXPECT_FALSE(parsed<float>("1e99"));
}

TEST(WithoutPlus, TakesOneSignAway) {
  EXPECT_EQ(without_plus("+1.5"), "1.5");
  EXPECT_EQ(without_plus("++1"), "+1");
  EXPECT_EQ(without_plus("-1"), "-1");
  EXPECT_EQ(without_plus(""), "");
}

}  // namespace
}  // namespace plotscan
