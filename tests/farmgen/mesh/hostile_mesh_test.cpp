// SPDX-License-Identifier: Apache-2.0
// Files made to crash, hang or exhaust a reader of meshes get one message.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "mesh/mesh_import.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace plotscan::mesh {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::kSanitized;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const fs::path& path) {
  return message_of<InputError>([&] { import_mesh(path); });
}

// A triangle, with these nodes of the library and of the scene.
std::string dae(const std::string& library, const std::string& nodes) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="m"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0.5</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_nodes>)" +
         library + R"(</library_nodes><library_visual_scenes><visual_scene id="s"><node id="n">)" +
         nodes + R"(</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

constexpr const char* kCircle =
    R"(<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node>)";

TEST(HostileMesh, OneThatCrashesItsReaderIsNamedAmongOthers) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the child's crash as its own";
  const TemporaryFolder folder;
  const std::string triangle = R"(<instance_geometry url="#g"/>)";
  const MeshFile sound{.path = folder.write("sound.dae", dae("", triangle))};
  MeshReader reader({sound,
                     {.path = folder.write(
                          "circle.dae", dae(kCircle, triangle + R"(<instance_node url="#a"/>)"))},
                     sound});
  EXPECT_EQ(reader.next().mesh.triangles.size(), 1U);
  EXPECT_THAT(message_of<InputError>([&] { reader.next(); }),
              AllOf(HasSubstr("circle.dae: "), HasSubstr("crashed")));
  EXPECT_EQ(reader.next().mesh.triangles.size(), 1U);
}

TEST(HostileMesh, NodesInACircleDoNoHarm) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the child's crash as its own";
  const TemporaryFolder folder;
  const std::string triangle = R"(<instance_geometry url="#g"/>)";
  EXPECT_THAT(
      refusal(folder.write("circle.dae", dae(kCircle, triangle + R"(<instance_node url="#a"/>)"))),
      AllOf(HasSubstr("circle.dae: cannot be read as a mesh"), HasSubstr("crashed")));
  EXPECT_EQ(import_mesh(folder.write("sound.dae", dae("", triangle))).triangles.size(), 1u)
      << "the next mesh is read as ever";
}

TEST(HostileMesh, DeeplyNestedNodesDoNoHarm) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the child's crash as its own";
  const TemporaryFolder folder;
  const std::string deep = repeated("<node>", 50'000) + repeated("</node>", 50'000);
  EXPECT_THAT(
      refusal(folder.write("deep.dae", dae("", R"(<instance_geometry url="#g"/>)" + deep))),
      AllOf(HasSubstr("deep.dae: cannot be read as a mesh"), HasSubstr("nested too deeply")));
}

TEST(HostileMesh, AGlbThatClaimsMoreThanItHasIsRefused) {
  const TemporaryFolder folder;
  std::string bytes("glTF");
  for (const std::uint32_t word : {2u, 4'000'000'000u, 4'000'000'000u})
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  EXPECT_THAT(refusal(folder.write("t.glb", bytes + "JSON")),
              HasSubstr("t.glb: promises 4000000000 bytes, but has 20"));
}

TEST(HostileMesh, AFileThatClaimsMoreThanTheLimitIsRefused) {
  const TemporaryFolder folder;
  const std::string message = refusal(folder.write(
      "t.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 400000000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 400000000\n"
      "property list uchar int vertex_indices\nend_header\nabc"));
  EXPECT_THAT(message, HasSubstr("t.ply: "));
}

TEST(HostileMesh, ABufferOutsideTheFolderIsNotOpened) {
  const TemporaryFolder folder;
  folder.write("buffer.bin", std::string(42, 'x'));
  const auto gltf = [](const std::string& uri) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"buffers": [{"uri": ")" +
           uri + R"(", "byteLength": 42}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
{"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";
  };
  for (const char* uri : {"../buffer.bin", "x/../../buffer.bin"}) {
    EXPECT_THAT(refusal(folder.write("models/t.gltf", gltf(uri))),
                AllOf(HasSubstr("t.gltf: names "), HasSubstr("leaves its folder")))
        << uri;
  }
}

// Assimp 5.4 (Debian 13) takes a time that grows with their square: 300,000 corners take half a
// minute, millions end at the time limit of its process.
TEST(HostileMesh, AFaceOfManyCornersIsRefused) {
  const TemporaryFolder folder;
  const std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + repeated(" 1 2 3", 20'000) + "\n";
  EXPECT_THAT(refusal(folder.write("t.obj", face)),
              HasSubstr("has a face of 60000 corners; at most 10000 are read"));
}

TEST(HostileMesh, AVertexBeyondAnyFieldIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.write("t.obj", "v 1e30 0 0\nv 1 0 0\nv 0 1 1e30\nf 1 2 3\n")),
              HasSubstr("further than 10000000 m"));
}

}  // namespace
}  // namespace plotscan::mesh
