// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include <filesystem>

#include "temporary_folder.h"
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "mesh/measure.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"

namespace plotscan::mesh {
namespace {

using plotscan::testing::TemporaryFolder;

// The smallest bytes that pass for a PNG here; nothing decodes them.
const std::string kPng = "\x89PNG\r\n\x1a\n";

// A unit square in the plane z = 0, of one material.
Mesh square(const Material& material) {
  return {.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .materials = {material},
          .triangle_material = {0, 0},
          .texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

Mesh two_squares() {
  Mesh mesh = square({.name = "leaf",
                      .colour = {0.1F, 0.5F, 0.2F},
                      .texture = std::make_shared<Image>(Image{"leaf.png", kPng})});
  append(mesh, square({.name = "stem", .colour = {0.3F, 0.4F, 0.1F}, .texture = {}}));
  return mesh;
}

// A box of 2 x 3 x 5 m without its bottom.
Mesh open_box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? 2 : 0, i & 2 ? 3 : 0, i & 4 ? 5 : 0);
  }
  mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 7, 3},
                    {2, 6, 7}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(ScaledArea, AreaOfAScaledBoxIsThatOfItsSides) {
  EXPECT_DOUBLE_EQ(ScaledArea(open_box()).at({1, 1, 1}), 2 * 3 + 2 * (2 + 3) * 5);
  EXPECT_DOUBLE_EQ(ScaledArea(open_box()).at({0.5, 2, 3}), 1 * 6 + 2 * (1 + 6) * 15);
}

TEST(Mesh, AppendingKeepsMaterialsApartAndJoinsEqualOnes) {
  Mesh mesh = two_squares();
  append(mesh, two_squares());
  EXPECT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.triangle_material, (std::vector<std::uint16_t>{0, 0, 1, 1, 0, 0, 1, 1}));
  EXPECT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
  EXPECT_DOUBLE_EQ(ScaledArea(mesh).at(), 4);
  EXPECT_DOUBLE_EQ(ScaledArea::of_leaves(mesh).at({2, 3, 1}), 2 * 6);
}

TEST(Mesh, AppendingToNothingIsACopy) {
  Mesh mesh;
  append(mesh, two_squares());
  EXPECT_EQ(mesh.vertices, two_squares().vertices);
  EXPECT_EQ(mesh.triangle_material, two_squares().triangle_material);
}

TEST(Mesh, ObjKeepsMaterialsAndTextures) {
  const TemporaryFolder folder;
  write_obj(folder.path() / "squares.obj", two_squares());
  EXPECT_EQ(read_text(folder.path() / "leaf.png"), kPng);
  const Mesh read = import_mesh(folder.path() / "squares.obj");
  ASSERT_EQ(read.materials.size(), 2u);
  EXPECT_EQ(read.materials[0].name, "leaf");
  EXPECT_EQ(read.materials[0].colour, Eigen::Vector3f(0.1F, 0.5F, 0.2F));
  ASSERT_NE(read.materials[0].texture, nullptr);
  EXPECT_EQ(read.materials[0].texture->bytes, kPng);
  EXPECT_EQ(read.materials[1].name, "stem");
  EXPECT_EQ(read.materials[1].texture, nullptr);
  EXPECT_EQ(read.triangle_material, two_squares().triangle_material);
  EXPECT_DOUBLE_EQ(ScaledArea::of_leaves(read).at(), 1);

  Assimp::Importer other_reader;
  const aiScene* scene = other_reader.ReadFile((folder.path() / "squares.obj").string(), 0);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->mNumMeshes, 2u) << "one a material";
}

TEST(Mesh, ATextureThatIsAbsentIsLeftOut) {
  const TemporaryFolder folder;
  folder.write("t.mtl", "newmtl leaf\nKd 0.1 0.2 0.3\nmap_Kd missing.png\n");
  const Mesh mesh = import_mesh(folder.write(
      "t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl leaf\nf 1/1 2/1 3/1\n"));
  ASSERT_EQ(mesh.materials.size(), 1u);
  EXPECT_EQ(mesh.materials[0].texture, nullptr);
  EXPECT_TRUE(mesh.texture_coordinates.empty());
}

}  // namespace
}  // namespace plotscan::mesh
