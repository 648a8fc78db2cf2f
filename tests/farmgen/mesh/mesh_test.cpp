// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include <array>
#include <filesystem>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "farmgen/mesh/append.h"
#include "mesh/alpha_mask.h"
#include "mesh/image_names.h"
#include "mesh/measure.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"
#include "temporary_folder.h"
#include "test_images.h"

namespace plotscan::mesh {
namespace {

using plotscan::testing::append;
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

TEST(ScaledArea, OfLeavesIsThatOfTheirMaterials) {
  Mesh mesh = two_squares();
  EXPECT_DOUBLE_EQ(ScaledArea(mesh).at(), 2);
  EXPECT_DOUBLE_EQ(ScaledArea::of_leaves(mesh).at({2, 3, 1}), 6);
  for (const char* leaf : {"Leaf.001", "LEAVES", "blade_2"}) {
    mesh.materials[0].name = leaf;
    EXPECT_DOUBLE_EQ(ScaledArea::of_leaves(mesh).at(), 1) << leaf;
  }
  mesh.materials[0].name = "husk";
  EXPECT_DOUBLE_EQ(ScaledArea::of_leaves(mesh).at(), 2) << "none is called so";
}

// Of one folder: a scan's mesh, whose leaf has a texture and a mask of one name, and a light one.
TEST(Mesh, ImagesOfOneNameAreNamedApart) {
  const auto image = [](const std::string& bytes) {
    return std::make_shared<const Image>(Image{"leaf.png", bytes});
  };
  Mesh scan = square({.name = "leaf", .texture = image(kPng + "1")});
  const std::string mask =
      plotscan::testing::png_of_alpha(2, 2, [](int i, int) { return 255 * i; });
  scan.materials[0].mask = std::make_shared<const AlphaMask>(image(mask), 0.5F, "leaf.png");
  Mesh light = square({.name = "leaf", .texture = image(kPng + "2")});
  append(light, square({.name = "stem", .texture = image(kPng + "1")}));
  const std::array meshes = {&scan, &light};
  name_images_apart(meshes);
  EXPECT_EQ(scan.materials[0].texture->name, "leaf.png");
  EXPECT_EQ(scan.materials[0].mask->image()->name, "leaf_2.png");
  EXPECT_EQ(light.materials[0].texture->name, "leaf_3.png");
  EXPECT_EQ(light.materials[1].texture->name, "leaf.png") << "the same bytes";
  EXPECT_FALSE(scan.materials[0].mask->is_opaque({0.2F, 0.5F}));
  EXPECT_TRUE(scan.materials[0].mask->is_opaque({0.8F, 0.5F}));

  const TemporaryFolder folder;
  write_obj(folder.path() / "scan.obj", scan);
  write_obj(folder.path() / "light.obj", light);
  EXPECT_EQ(read_text(folder.path() / "leaf.png"), kPng + "1");
  EXPECT_EQ(read_text(folder.path() / "leaf_2.png"), mask);
  EXPECT_EQ(read_text(folder.path() / "leaf_3.png"), kPng + "2");
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
