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

TEST(LowerExtension, IsOfTheNameWithItsDot) {
  EXPECT_EQ(lower_extension("FIELD.v2.LAS"), ".las");
  EXPECT_EQ(lower_extension("FIELD.LAS/cloud"), "");
  EXPECT_EQ(lower_case("Z\xC3\x84 9"), "z\xC3\x84 9");  // ASCII alone
}

}  // namespace
}  // namespace plotscan
