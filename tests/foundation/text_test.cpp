// SPDX-License-Identifier: Apache-2.0
#include "core/text.h"

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(Formatted, IsPrintfOfAnyLength) {
  EXPECT_EQ(formatted("%s: %.2f m", "height", 1.005001), "height: 1.01 m");
  EXPECT_EQ(formatted("%s", std::string(5000, 'x').c_str()), std::string(5000, 'x'));
  EXPECT_EQ(formatted("%d %%", 7), "7 %");
}

TEST(Joined, PutsTheSeparatorBetween) {
  EXPECT_EQ(joined({"a", "b", "c"}, ", "), "a, b, c");
  EXPECT_EQ(joined({}, ", "), "");
}

}  // namespace
}  // namespace plotscan
