// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_section.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

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

// To yaml-cpp these are empty documents without end.
TEST(YamlSection, BracketsThatBelongToNothingEnd) {
  EXPECT_THAT(refusal("a: 1\n--- , b\n"), HasSubstr(":2: begins a second YAML document"));
  EXPECT_THAT(refusal(", a: {b: 2}}\n"), HasSubstr("is not a map of keys to values"));
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

TEST(YamlSection, KeysThatNobodyAskedForAreRefused) {
  const std::string text = "a: 1\nb: {c: 2, d: 3}\nlist:\n  - {e: 4}\n  - {e: 5, f: 6}\n";
  const auto read = [&](const std::string& more, bool reads_all) {
    const YamlSection root = YamlSection::parse(text + more, "f.yaml");
    root.number("a", {0, 9});
    root.has("z");
    const YamlSection b = root.section("b");
    b.number("c", {0, 9});
    if (reads_all) b.number("d", {0, 9});
    for (const YamlSection& entry : root.list("list", 9)) {
      entry.number("e", {0, 9});
      if (reads_all) entry.has("f");
    }
    root.refuse_unread();
  };
  const auto message = [&](const std::string& more, bool reads_all) {
    return message_of<InputError>([&] { read(more, reads_all); });
  };
  EXPECT_NO_THROW(read("", true));
  EXPECT_NO_THROW(read("z: 1\n", true)) << "what is asked for need not be read";
  EXPECT_EQ(message("y: 1\n", true),
            "f.yaml:6: y is not a known key; known here are a, z, b, list");
  EXPECT_EQ(message("a: 2\n", true), "f.yaml:6: a is given twice");
  EXPECT_EQ(message("", false), "f.yaml:2: b.d is not a known key; known here are c");
}

TEST(YamlSection, AKeyOfAnyEntryOfAListIsRefused) {
  const YamlSection root = YamlSection::parse("list: [{e: 4}, {e: 5, f: 6}, 7]\n", "f.yaml");
  for (const YamlSection& entry : root.list("list", 9, "e")) entry.number("e", {0, 9});
  EXPECT_EQ(message_of<InputError>([&] { root.refuse_unread(); }),
            "f.yaml:1: list.1.f is not a known key; known here are e");
}

TEST(YamlSection, AMissingKeyNamesTheOneThatIsSpeltNearlySo) {
  const YamlSection root = YamlSection::parse("length_m: 1\nwidht_m: 2\n", "f.yaml");
  const auto missing = [&](const char* key) {
    return message_of<InputError>([&] { root.number(key, {0, 9}); });
  };
  EXPECT_EQ(missing("width_m"), "f.yaml:2: widht_m is not a known key, and width_m is missing");
  EXPECT_EQ(missing("colour"), "f.yaml:1: colour is missing");
  root.has("widht_m");
  EXPECT_EQ(missing("width_m"), "f.yaml:1: width_m is missing") << "a known key is not misspelt";
}

TEST(YamlSection, AnEmptyValueIsNamed) {
  const auto message = [](const std::string& text) {
    return message_of<InputError>([&] { YamlSection::parse(text, "f.yaml").number("a", {0, 9}); });
  };
  EXPECT_EQ(message("a:\n"), "f.yaml:1: a has no value");
  EXPECT_EQ(message("a: [1]\n"), "f.yaml:1: a is not a single value");
}

// The file has no list: nothing in it is to blame.
TEST(YamlSection, AnEntryOfAListThatIsNotThereIsRefused) {
  const auto message = [](const std::string& assignment) {
    return message_of<InputError>([&] {
      YamlSection::parse("a: {b: 1}\n", "f.yaml", {assignment}).section("a").list("ways", 9);
    });
  };
  EXPECT_EQ(message("a.ways.0.width=2"),
            "--set a.ways.0.width=2: there is no list a.ways of which 0 would be an entry; set the "
            "whole list, as in --set a.ways=[...]");
  EXPECT_EQ(message("a.ways.width=2"),
            "--set a.ways.width=2: a.ways is not a list of 1 to 9 entries");
  EXPECT_NO_THROW(YamlSection::parse("a: 1\n", "f.yaml", {"ways=[{width: 2}]"}).list("ways", 9));
}

}  // namespace
}  // namespace plotscan
