// SPDX-License-Identifier: Apache-2.0
#include "core/format_version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/yaml_section.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

const std::string kNewer = std::to_string(kFormat + 1);

class Format : public ::testing::Test {
 protected:
  // The folder's manifest with this for its format, or without any.
  void write_manifest_of(const std::string& format) {
    folder_.write("manifest.json",
                  format.empty() ? "{}" : "{\"format\": " + format + ", \"options\": {}}");
  }
  void read_map(const std::string& members) {
    read_plot_features(folder_.write(
        "plots.geojson", "{\"type\": \"FeatureCollection\", \"features\": []" + members + "}"));
  }
  static void read_yaml(const std::string& text) {
    YamlSection::parse(text, "farm.yaml").allow_only({"a"});
  }

  TemporaryFolder folder_;
};

TEST_F(Format, FoldersSayTheirsAndNewerOnesAreRefused) {
  write_manifest(folder_.path(), {.command = "farmgen generate"});
  EXPECT_EQ(read_manifest(folder_.path())["format"], kFormat);
  for (const char* old : {"", "0"}) {
    write_manifest_of(old);
    EXPECT_NO_THROW(read_manifest(folder_.path())) << old;
  }
  for (const std::string& foreign : {kNewer, std::string("18446744073709551615")}) {
    write_manifest_of(foreign);
    EXPECT_THAT(message_of<InputError>([&] { read_manifest(folder_.path()); }),
                AllOf(HasSubstr("manifest.json: is of format " + foreign), HasSubstr(version())));
  }
  for (const char* none : {"-1", "1.5", "\"one\"", "null", "[]"}) {
    write_manifest_of(none);
    EXPECT_THAT(message_of<InputError>([&] { read_manifest(folder_.path()); }),
                HasSubstr("no whole number"))
        << none;
  }
}

TEST_F(Format, MapsOfOursSayTheirs) {
  EXPECT_EQ(plot_collection({})["format"], kFormat);
  const std::string ours = R"(, "coordinate_system": "local metres")";
  EXPECT_NO_THROW(read_map(ours));
  EXPECT_THAT(message_of<InputError>([&] { read_map(ours + ", \"format\": " + kNewer); }),
              HasSubstr("of format " + kNewer));
  // Of a map of others, "format" is theirs.
  EXPECT_NO_THROW(read_map(R"(, "format": "QGIS")"));
}

TEST_F(Format, DescriptionsMaySayTheirs) {
  EXPECT_NO_THROW(read_yaml("a: 1\n"));
  EXPECT_NO_THROW(read_yaml("format: 0\na: 1\n"));
  EXPECT_NO_THROW(read_yaml("a: 1\nformat: " + std::to_string(kFormat) + "\n"));
  const auto refusal = [](const std::string& text) {
    return message_of<InputError>([&] { read_yaml(text); });
  };
  EXPECT_THAT(refusal("a: 1\nformat: " + kNewer + "\n"),
              AllOf(HasSubstr("farm.yaml:2: format"), HasSubstr("is of format " + kNewer)));
  EXPECT_THAT(refusal("format: new\n"), HasSubstr("no whole number"));
  EXPECT_THAT(refusal("a: 1\nb: 1\n"), HasSubstr("not a known key"));
}

}  // namespace
}  // namespace plotscan
