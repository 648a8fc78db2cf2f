// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_import.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/error.h"
#include "mesh/measure.h"
#include "temporary_folder.h"

namespace plotscan::mesh {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// One tetrahedron with edges of 1 m (x), 2 m (y) and 3 m (z) from its foot at the origin, in every
// format, unit and up axis.
constexpr const char* kObjZUp =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
// y up: (x, y, z) of ours is (x, z, -y) of theirs.
constexpr const char* kObjYUpCentimetres =
    "v 0 0 0\nv 100 0 0\nv 0 0 -200\nv 0 300 0\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string stl() {
  const std::array<Eigen::Vector3f, 4> v = {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}};
  std::string text = "solid tetrahedron\n";
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : {a, b, c}) {
      text += "vertex " + std::to_string(v[i].x()) + " " + std::to_string(v[i].y()) + " " +
              std::to_string(v[i].z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

std::string collada(const std::string& asset, const std::string& positions,
                    const std::string& node = "") {
  return "<?xml version=\"1.0\"?>\n"
         "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
         "<asset>" +
         asset +
         "</asset>\n"
         "<library_geometries><geometry id=\"g\"><mesh>\n"
         "<source id=\"p\"><float_array id=\"pa\" count=\"12\">" +
         positions +
         "</float_array>\n"
         "<technique_common><accessor source=\"#pa\" count=\"4\" stride=\"3\">\n"
         "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n"
         "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n"
         "<p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles></mesh></geometry></library_geometries>\n"
         "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">\n" +
         node +
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

template <class Number>
void append(std::string& bytes, std::initializer_list<Number> values) {
  for (const Number value : values) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

// A glTF with its buffer beside it; its node scales the mesh by 0.01, so the buffer holds
// centimetres.
fs::path write_gltf(const TemporaryFolder& folder) {
  std::string buffer;
  append<float>(buffer, {0, 0, 0, 100, 0, 0, 0, 0, -200, 0, 300, 0});
  append<std::uint16_t>(buffer, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
  folder.write("t.bin", buffer);
  return folder.write(
      "t.gltf",
      "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n"
      "\"nodes\": [{\"mesh\": 0, \"scale\": [0.01, 0.01, 0.01]}],\n"
      "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}],\n"
      "\"buffers\": [{\"uri\": \"t.bin\", \"byteLength\": 72}],\n"
      "\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48},\n"
      "                  {\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 24}],\n"
      "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4,\n"
      "  \"type\": \"VEC3\", \"min\": [0, 0, -200], \"max\": [100, 300, 0]},\n"
      "  {\"bufferView\": 1, \"componentType\": 5123, \"count\": 12, \"type\": \"SCALAR\"}]}\n");
}

// The four vertices and the outward volume of the tetrahedron.
// Negative where the faces look inward.
float volume_of(const Mesh& mesh) {
  float volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return volume;
}

void expect_tetrahedron(const Mesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const Eigen::Vector3f& expected :
       {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}) {
    EXPECT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                            [&](const auto& vertex) { return (vertex - expected).norm() < 1e-5F; }))
        << "no vertex at " << expected.transpose();
  }
  EXPECT_NEAR(volume_of(mesh), 1.0F, 1e-4F) << "faces keep looking outward";
}

TEST(MeshImport, EveryFormatMakesTheSameTetrahedron) {
  const TemporaryFolder folder;
  const std::string z_up = "0 0 0 1 0 0 0 2 0 0 0 3";
  const std::string y_up_inches = "0 0 0 39.3700787 0 0 0 0 -78.7401575 0 118.110236 0";
  expect_tetrahedron(import_mesh(folder.write("t.obj", kObjZUp)));
  expect_tetrahedron(
      import_mesh(folder.write("y.OBJ", kObjYUpCentimetres), {.up = UpAxis::y, .unit_m = 0.01}));
  expect_tetrahedron(import_mesh(folder.write("t.ply", kPly)));
  expect_tetrahedron(import_mesh(folder.write("t.stl", stl())));
  expect_tetrahedron(import_mesh(write_gltf(folder)));
  expect_tetrahedron(import_mesh(
      folder.write("z.dae", collada("<unit meter=\"1\"/><up_axis>Z_UP</up_axis>", z_up))));
  expect_tetrahedron(import_mesh(folder.write(
      "y.dae", collada("<unit meter=\"0.0254\"/><up_axis>Y_UP</up_axis>", y_up_inches))));
}

// Assimp leaves such vertices out, and all faces have other corners then.
TEST(MeshImport, NumbersWithoutALeadingZeroAreNumbers) {
  const TemporaryFolder folder;
  expect_tetrahedron(
      import_mesh(folder.write("dots.obj",
                               "v .0 0 -.0\nv 1 +.0 0 .5 .5 .5 # as it stands: .5\nv 0 2 .0\n"
                               "v\t0\t.0\t3\nf 1 3 2 # base\nf 1 2 4\nf 2 3 4\nf 1 4 3")));
  const Mesh half = import_mesh(
      folder.write("half.obj", "v .5 0 0\nv 1 -.5 0\nv 0 0 .25\nvt .5 .5\nf 1/1 2/1 3/1\n"));
  ASSERT_EQ(half.triangles.size(), 1U);
  Eigen::AlignedBox3f box;
  for (const std::uint32_t corner : half.triangles.front()) box.extend(half.vertices[corner]);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0, -0.5F, 0)));
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(1, 0, 0.25F)));
}

// As programs write symmetric parts.
TEST(MeshImport, ANodeThatMirrorsKeepsFacesLookingOutward) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(
      folder.write("m.dae", collada("<unit meter=\"1\"/><up_axis>Z_UP</up_axis>",
                                    "0 0 0 1 0 0 0 2 0 0 0 3", "<scale>-1 1 1</scale>")));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const Eigen::Vector3f& vertex : mesh.vertices) EXPECT_LE(vertex.x(), 0);
  EXPECT_NEAR(volume_of(mesh), 1.0F, 1e-4F);
}

TEST(MeshImport, WhatTheUserSaysCountsMoreThanTheFile) {
  const TemporaryFolder folder;
  const std::string z_up = "0 0 0 1 0 0 0 2 0 0 0 3";
  const fs::path file =
      folder.write("t.dae", collada("<unit meter=\"0.01\"/><up_axis>Y_UP</up_axis>", z_up));
  expect_tetrahedron(import_mesh(file, {.up = UpAxis::z, .unit_m = 100}));
}

TEST(MeshImport, FootPutsTheLowestVertexAtZero) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("t.obj", "v 0 0 -2\nv 1 0 -2\nv 0 1 5\nf 1 2 3\n");
  EXPECT_EQ(mesh_height(import_mesh(file)), 5);
  EXPECT_EQ(mesh_height(import_mesh(file, {.foot = MeshFoot::lowest})), 7);
}

TEST(MeshImport, DropsTrianglesWithoutAreaAndSharesVertices) {
  const TemporaryFolder folder;
  const Mesh mesh =
      import_mesh(folder.write("t.obj",
                               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 1 0 0\n"
                               "f 1 2 3 4\nf 1 2 5\nf 1 1 3\nf 6 5 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 3u) << "the square's two and the last";
  EXPECT_EQ(mesh.vertices.size(), 5u) << "vertex 6 is vertex 2";
}

TEST(MeshImport, RefusesWhatIsNoMesh) {
  const TemporaryFolder folder;
  const auto message = [](const fs::path& path) {
    return message_of<InputError>([&] { import_mesh(path); });
  };
  EXPECT_THAT(message(folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
              HasSubstr("nan.obj: a vertex is not finite"));
  EXPECT_THAT(message(folder.write("inf.obj", "v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
              HasSubstr("inf.obj: a vertex is not finite"));
  EXPECT_THAT(message(folder.write("empty.obj", "")), HasSubstr("empty.obj: "));
  EXPECT_THAT(message(folder.write("points.obj", "v 0 0 0\nv 1 0 0\n")), HasSubstr("points.obj: "));
  EXPECT_THAT(message(folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
              HasSubstr("line.obj: has no triangle with an area"));
  EXPECT_THAT(message(folder.write("broken.dae", "<COLLADA><asset>")),
              HasSubstr("broken.dae: cannot be read as a mesh"));
  EXPECT_THAT(message(folder.write("broken.gltf", "{\"asset\": ")),
              HasSubstr("broken.gltf: cannot be read as a mesh"));
  EXPECT_THAT(message(folder.write("mesh.blend", "BLENDER")),
              HasSubstr("mesh.blend: is not a mesh format that is read"));
  EXPECT_THAT(message(folder.path() / "missing.obj"), HasSubstr("missing.obj: no such file"));
  EXPECT_THAT(message(folder.path()), HasSubstr("not a regular file"));
}

TEST(MeshImport, ThirdPartyPlantsHaveTheHeightsTheirAuthorsGive) {
  const fs::path plants = fs::path(PLOTSCAN_SHARED_DATA_DIR) / "plants" / "cropcraft";
  if (!fs::exists(plants)) GTEST_SKIP() << plants << " is absent";
  int read = 0;
  for (const char* crop : {"bean", "maize"}) {
    const YAML::Node description = YAML::LoadFile((plants / crop / "description.yaml").string());
    for (const auto& model : description["models"]) {
      const fs::path file = plants / crop / model["filename"].as<std::string>();
      if (!fs::exists(file)) continue;
      const Mesh mesh = import_mesh(file);
      // The maize's stated height is to the top of its stem: its leaves reach 8 cm higher.
      const double tolerance_m = std::string(crop) == "maize" ? 0.1 : 0.01;
      EXPECT_NEAR(mesh_height(mesh), model["height"].as<double>(), tolerance_m) << file;
      EXPECT_GT(mesh.triangles.size(), 200u) << file;
      EXPECT_TRUE(std::any_of(mesh.materials.begin(), mesh.materials.end(),
                              [](const auto& material) { return material.texture != nullptr; }))
          << "the leaf's picture";
      ++read;
    }
  }
  EXPECT_EQ(read, 3);
}

TEST(MeshReader, GivesTheFilesInTheirOrderAndEachsErrorAtItsTurn) {
  const TemporaryFolder folder;
  const MeshFile large{.path = folder.write("large.obj", kObjZUp)};
  const MeshFile small{.path = folder.write("small.obj", kObjYUpCentimetres),
                       .options = {.up = UpAxis::y, .unit_m = 0.005}};
  const MeshFile broken{.path =
                            folder.write("broken.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")};
  const MeshFile missing{.path = folder.path() / "missing.obj"};
  MeshReader sound({large, small, large});
  for (const double height_m : {3.0, 1.5, 3.0})
    EXPECT_NEAR(mesh_height(sound.next().mesh), height_m, 1e-6);
  MeshReader reader({small, broken, large, missing});
  EXPECT_NEAR(mesh_height(reader.next().mesh), 1.5, 1e-6);
  EXPECT_EQ(message_of<InputError>([&] { reader.next(); }),
            message_of<InputError>([&] { import_mesh(broken.path); }));
  EXPECT_NEAR(mesh_height(reader.next().mesh), 3, 1e-6);
  EXPECT_THAT(message_of<InputError>([&] { reader.next(); }), HasSubstr("missing.obj: no such"));
}

}  // namespace
}  // namespace plotscan::mesh
