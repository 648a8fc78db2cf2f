// SPDX-License-Identifier: Apache-2.0
#include "core/text.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/column_text.h"
#include "core/list_of.h"

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

TEST(Text, IsSplitAtEverySeparator) {
  using List = std::vector<std::string>;
  EXPECT_EQ(split("a,,b,", ','), (List{"a", "", "b", ""}));
  EXPECT_EQ(split("", ','), List{""});
}

TEST(Text, LosesTheBlanksAtItsEndsAlone) {
  EXPECT_EQ(without_blanks(" \t a b\r"), "a b");
  EXPECT_EQ(without_blanks(" \t"), "");
  EXPECT_EQ(without_blanks("\na\n", "\n"), "a");
}

TEST(Text, HasItsEscapesInOneGo) {
  EXPECT_EQ(with_escapes("a\\'b", {{'\\', "\\\\"}, {'\'', "\\'"}}), "a\\\\\\'b");
  EXPECT_EQ(with_escapes("ab", {{'a', "b"}, {'b', ""}}), "b");
}

TEST(ColumnText, NeverLeavesItsColumn) {
  EXPECT_EQ(column_text(-0.05, 8), "   -0.05");
  EXPECT_EQ(column_text(1.5, 7, true), "  +1.50");
  EXPECT_EQ(column_text(-123456.78, 8), " -123457");
  EXPECT_EQ(column_text(-3987654.3, 8), "  -4e+06");
  EXPECT_EQ(column_text(std::numeric_limits<double>::quiet_NaN(), 5), "    -");
}

TEST(ListOf, GivesAMemberOrWhatAFunctionMakesOfEachItem) {
  const std::vector<std::pair<int, const char*>> items = {{1, "one"}, {2, "two"}};
  EXPECT_EQ(list_of(items, &std::pair<int, const char*>::first), (std::vector{1, 2}));
  EXPECT_EQ(list_of(items, [](const auto& item) { return 0.5 * item.first; }),
            (std::vector{0.5, 1.0}));
  EXPECT_EQ(list_of<std::string>(items, &std::pair<int, const char*>::second),
            (std::vector<std::string>{"one", "two"}));
}

}  // namespace
}  // namespace plotscan
