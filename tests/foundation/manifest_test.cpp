// SPDX-License-Identifier: Apache-2.0
#include "core/manifest.h"

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

TEST(FileHash, IsXxh128) {
  const testing::TemporaryFolder folder;
  // What xxh128sum prints for an empty file.
  EXPECT_EQ(file_hash(folder.write("empty", "")), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(file_hash(folder.write("a", "a")), file_hash(folder.write("b", "b")));
}

TEST(Manifest, ListsOptionsInputsAndOutputs) {
  const testing::TemporaryFolder folder;
  const auto input = folder.write("in/farm.yaml", "x: 1\n");
  folder.write("out/world.sdf", "<sdf/>");
  folder.write("out/models/a.obj", "v 0 0 0");
  write_manifest(
      folder.path() / "out",
      {.command = "farmgen generate", .seed = 3, .options = {{"a", 1}}, .inputs = {input}});
  const auto document = read_manifest(folder.path() / "out");
  EXPECT_EQ(document["seed"], 3);
  EXPECT_EQ(document["options"]["a"], 1);
  EXPECT_EQ(document["inputs"][0]["file"], "farm.yaml");
  ASSERT_EQ(document["outputs"].size(), 2u);
  EXPECT_EQ(document["outputs"][0]["file"], "models/a.obj");
  EXPECT_EQ(document["outputs"][1]["hash"], file_hash(folder.path() / "out/world.sdf"));
  EXPECT_THROW(read_manifest(folder.path() / "in"), InputError);
}

TEST(Manifest, KnowsTheCloudThatWasMeasured) {
  const testing::TemporaryFolder folder;
  const auto cloud = folder.write("cloud.xyz", "1 2 3\n");
  const auto other = folder.write("other.xyz", "1 2 4\n");
  folder.write("estimate/plots.geojson", "");
  const auto estimate = folder.path() / "estimate";
  EXPECT_EQ(other_cloud_note(estimate, other), std::nullopt);
  write_manifest(estimate, {.command = "estimator run", .inputs = {cloud}});
  EXPECT_EQ(other_cloud_note(estimate, cloud), std::nullopt);
  EXPECT_EQ(other_cloud_note(estimate, folder.write("renamed.xyz", "1 2 3\n")), std::nullopt);
  EXPECT_EQ(other_cloud_note(estimate, other),
            "The cloud " + other.string() +
                " is not the file that this estimate was made from (its manifest.json has another "
                "hash).");
}

}  // namespace
}  // namespace plotscan
