// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_section.h"

#include <string>

#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace plotscan {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { YamlSection::parse(text, "f.yaml"); });
}

TEST(YamlSection, ASecondDocumentIsRefused) {
  EXPECT_EQ(YamlSection::parse("---\na: 1\n...\n", "f.yaml").number("a", {0, 1}), 1);
  EXPECT_THAT(refusal("a: 1\n---\na: 2\n"), HasSubstr("begins a second YAML document"));
  EXPECT_THAT(refusal(""), HasSubstr("f.yaml:1: is not a map"));
}

TEST(YamlSection, TextThatIsNotUtf8IsRefusedWithItsLine) {
  EXPECT_EQ(YamlSection::parse("name: M\xc3\xa4h\n", "f.yaml").text("name"), "M\xc3\xa4h");
  EXPECT_THAT(refusal("a: 1\nname: M\xe4h\n"), HasSubstr("f.yaml:2: is no UTF-8 text"));
}

TEST(YamlSection, AFileOfMillionsOfKeysIsRefusedBeforeItIsParsed) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "k" + std::to_string(i) + ": 1\n";
  EXPECT_THAT(refusal(text), HasSubstr("bytes; YAML is read up to 4000000"));
  const TemporaryFolder folder;
  const auto file = folder.write("f.yaml", text);
  EXPECT_THAT(message_of<InputError>([&] { YamlSection::load(file, {}); }),
              HasSubstr("YAML is read up to 4000000"));
}

}  // namespace
}  // namespace plotscan
