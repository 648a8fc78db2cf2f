// SPDX-License-Identifier: Apache-2.0
#include "core/text.h"

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(Joined, PutsTheSeparatorBetween) {
  EXPECT_EQ(joined({"a", "b", "c"}, ", "), "a, b, c");
  EXPECT_EQ(joined({}, ", "), "");
}

TEST(Alternatives, EndWithTheWordOr) {
  EXPECT_EQ(alternatives({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(alternatives({"a", "b"}), "a or b");
  EXPECT_EQ(alternatives({"a"}), "a");
  EXPECT_EQ(alternatives({}), "");
}

}  // namespace
}  // namespace plotscan
