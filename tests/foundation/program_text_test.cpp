// SPDX-License-Identifier: Apache-2.0
// What programs say: escapes, suggestions, time left.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/internal/time_left.h"
#include "core/nearest_name.h"
#include "core/printable.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using plotscan::testing::message_of;

TEST(Printable, ShowsControlBytesAndBrokenTextEscaped) {
  EXPECT_EQ(printable("plain, 20 % of it\n\tin\nlines"), "plain, 20 % of it\n\tin\nlines");
  EXPECT_EQ(printable("\x1b[31mred\x07\r\x7f"), "\\x1b[31mred\\x07\\x0d\\x7f");
  EXPECT_EQ(printable("M\xc3\xa4h \xe2\x82\xac \xf0\x9f\x8c\xbe"),
            "M\xc3\xa4h \xe2\x82\xac \xf0\x9f\x8c\xbe");
  EXPECT_EQ(printable("M\xe4h"), "M\\xe4h");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "a control character of two bytes";
  EXPECT_EQ(printable("\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x82"),
            "\\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80 \\xe2\\x82");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Utf8, IsRequiredWithTheLine) {
  EXPECT_NO_THROW(require_utf8("Gr\xc3\xbc\xc3\x9f\n", "f.csv"));
  EXPECT_EQ(message_of<InputError>([] { require_utf8("a\nb\nGr\xfc\xdf", "f.csv"); }),
            "f.csv:3: is no UTF-8 text; save it in that encoding");
}

TEST(NearestName, IsTheOneThatWasMeant) {
  const std::vector<std::string> commands = {"generate", "info", "check", "export", "plant"};
  EXPECT_EQ(nearest_name("genrate", commands), "generate");
  EXPECT_EQ(nearest_name("exprot", commands), "export");
  EXPECT_EQ(nearest_name("chek", commands), "check");
  EXPECT_EQ(nearest_name("fly", commands), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(5000, 'x'), commands), std::nullopt);
}

TEST(TimeLeft, OfEvenWorkIsExact) {
  TimeLeft time;
  EXPECT_EQ(time.at(1, 0.1), std::nullopt) << "too early to tell";
  for (int s = 2; s < 10; ++s) EXPECT_NEAR(time.at(s, 0.1 * s).value(), 10 - s, 1e-9);
}

TEST(TimeLeft, ASlowStartIsForgotten) {
  // Nothing for 1.5 s, then even work up to 15 s, told ten times a second.
  TimeLeft time;
  for (int i = 1; i < 150; ++i) {
    const double now_s = 0.1 * i;
    const double share = now_s < 1.5 ? 1e-4 * now_s : 1.5e-4 + (now_s - 1.5) / 13.51;
    const auto left_s = time.at(now_s, share);
    EXPECT_EQ(left_s.has_value(), now_s >= TimeLeft::kSilent_s) << now_s;
    EXPECT_LT(left_s.value_or(0), 60) << now_s;
    const double allowed_s = now_s > 6 ? 0.25 * (15 - now_s) + 0.5 : 60;
    EXPECT_NEAR(left_s.value_or(15 - now_s), 15 - now_s, allowed_s) << now_s;
  }
}

// Half a minute of loading is no part of 10 s of work.
TEST(TimeLeft, CountsFromWhereTheWorkBegins) {
  TimeLeft time;
  EXPECT_EQ(time.at(30, 0), std::nullopt);
  for (int s = 1; s < 10; ++s) {
    const auto left_s = time.at(30 + s, 0.1 * s);
    EXPECT_EQ(left_s.has_value(), s >= TimeLeft::kSilent_s) << s;
    EXPECT_NEAR(left_s.value_or(10 - s), 10 - s, 1e-9) << s;
  }
}

TEST(WriteError, SaysThatThereIsNoSpaceLeft) {
  EXPECT_STREQ(WriteError("/dev/full").what(), "no space left on /dev/full");
  EXPECT_STREQ(WriteError("/nowhere/f.csv").what(),
               "/nowhere/f.csv: cannot be written: No such file or directory");
}

}  // namespace
}  // namespace plotscan
