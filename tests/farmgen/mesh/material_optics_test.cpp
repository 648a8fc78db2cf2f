// SPDX-License-Identifier: Apache-2.0
// What materials say of light: reflectances and masks, through files and back.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "mesh/alpha_mask.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"
#include "mesh/reflectance.h"
#include "temporary_folder.h"
#include "test_images.h"

namespace plotscan::mesh {
namespace {

using plotscan::testing::jpeg_of_grey;
using plotscan::testing::message_of;
using plotscan::testing::png_of_alpha;
using plotscan::testing::png_of_grey;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A unit square, its texture's corners on its own.
constexpr const char* kSquare =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl leaf.001\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

Mesh square(const TemporaryFolder& folder, const std::string& material,
            std::vector<std::string>* notes = nullptr) {
  folder.write("m.mtl", "newmtl leaf.001\nKd 0.2 0.5 0.1\n" + material);
  return import_mesh(folder.write("m.obj", kSquare), {}, notes);
}

// Opaque in the left half and in the lowest quarter.
int left_or_low(int column, int row) { return column < 4 || row >= 6 ? 255 : 0; }

void expect_left_or_low(const Mesh& mesh) {
  ASSERT_NE(mesh.materials.at(0).mask, nullptr);
  const AlphaMask& mask = *mesh.materials[0].mask;
  EXPECT_EQ(mask.opaque_share(), 5.0 / 8);
  EXPECT_TRUE(mask.is_opaque({0.4F, 0.9F}));
  EXPECT_FALSE(mask.is_opaque({0.6F, 0.9F}));
  EXPECT_TRUE(mask.is_opaque({0.6F, 0.2F}));
  EXPECT_FALSE(mask.is_opaque({0.6F, 0.3F}));
  EXPECT_FALSE(mask.is_opaque({-2.4F, 5.9F})) << "the image is repeated";
  EXPECT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
}

TEST(Reflectance, IsWhatTheNameSays) {
  EXPECT_EQ(reflectance_by_name("leaf"), 0.45F);
  EXPECT_EQ(reflectance_by_name("Leaf.001"), 0.45F);
  EXPECT_EQ(reflectance_by_name("old_leaf"), 0.45F);
  EXPECT_EQ(reflectance_by_name("dry_leaf"), 0.50F);
  EXPECT_EQ(reflectance_by_name("stem"), 0.40F);
  EXPECT_EQ(reflectance_by_name("BeanStem2"), 0.40F);
  EXPECT_EQ(reflectance_by_name("ear"), 0.40F);
  EXPECT_EQ(reflectance_by_name("ripe_ear"), 0.40F);
  EXPECT_EQ(reflectance_by_name("soil"), 0.30F);
  EXPECT_EQ(reflectance_by_name("Ears_2"), 0.40F);
  EXPECT_EQ(reflectance_by_name("beanleaf"), 0.45F);
  for (const char* name : {"", "years", "earth", "plant", "material_0", "tripods", "System"})
    EXPECT_EQ(reflectance_by_name(name), std::nullopt) << name;
  EXPECT_EQ(reflectance_of({.name = "leaf", .reflectance = 0.2F}), 0.2F);
}

TEST(Reflectance, SurvivesAnObjFileAndItsMtl) {
  const TemporaryFolder folder;
  const Mesh mesh = square(folder, "# reflectance_903nm 0.37\n");
  EXPECT_EQ(mesh.materials.at(0).reflectance, 0.37F);
  write_obj(folder.path() / "again.obj", mesh);
  const Mesh again = import_mesh(folder.path() / "again.obj");
  EXPECT_TRUE(again.materials == mesh.materials);
  EXPECT_EQ(square(folder, "").materials.at(0).reflectance, std::nullopt);
}

TEST(Reflectance, ThatIsNoShareIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  for (const char* bad : {"1.2", "-0.1", "nan", "bright", "0.3 0.4"}) {
    const std::string message = message_of<InputError>(
        [&] { square(folder, std::string("# reflectance_903nm ") + bad + "\n"); });
    EXPECT_THAT(message, HasSubstr("m.mtl:3: # reflectance_903nm: \"" + std::string(bad)));
    EXPECT_THAT(message, HasSubstr("[0, 1]"));
  }
}

TEST(Mask, OfAGreyPngAJpegAndTheTexturesOwnAlpha) {
  const TemporaryFolder folder;
  folder.write("grey.png", png_of_grey(8, 8, left_or_low));
  folder.write("grey.jpg", jpeg_of_grey(64, 64, [](int column, int row) {
                 return left_or_low(column / 8, row / 8);
               }));
  folder.write("leaf.png", png_of_alpha(8, 8, left_or_low));
  expect_left_or_low(square(folder, "map_d grey.png\n"));
  expect_left_or_low(square(folder, "map_d grey.jpg\n"));
  expect_left_or_low(square(folder, "map_Kd leaf.png\n"));
  expect_left_or_low(square(folder, "map_Kd leaf.png\nmap_d leaf.png\n"));
  expect_left_or_low(square(folder, "map_Kd leaf.png\nmap_d grey.png\n"));
}

TEST(Mask, IsLeftOutWhereItHasNoHole) {
  const TemporaryFolder folder;
  folder.write("leaf.png", png_of_alpha(8, 8, [](int, int) { return 255; }));
  const Mesh mesh = square(folder, "map_Kd leaf.png\n");
  EXPECT_NE(mesh.materials.at(0).texture, nullptr);
  EXPECT_EQ(mesh.materials.at(0).mask, nullptr);
}

TEST(Mask, SurvivesAnObjFileAndItsMtl) {
  const TemporaryFolder folder;
  folder.write("leaf.png", png_of_alpha(8, 8, left_or_low));
  const Mesh mesh = square(folder, "map_Kd leaf.png\n");
  std::filesystem::create_directory(folder.path() / "out");
  write_obj(folder.path() / "out/again.obj", mesh);
  const Mesh again = import_mesh(folder.path() / "out/again.obj");
  expect_left_or_low(again);
  EXPECT_TRUE(again.materials == mesh.materials);
}

// A picture may be called as what is written beside it.
TEST(Mask, AnImageHasTheNameOfAPicture) {
  const TemporaryFolder folder;
  folder.write("images/again.mtl", png_of_alpha(8, 8, left_or_low));
  const Mesh mesh = square(folder, "map_Kd images/again.mtl\n");
  std::filesystem::create_directory(folder.path() / "out");
  write_obj(folder.path() / "out/again.obj", mesh);
  expect_left_or_low(import_mesh(folder.path() / "out/again.obj"));
}

TEST(Mask, HasTheCutoffThatTheFileStates) {
  const TemporaryFolder folder;
  folder.write("ramp.png", png_of_grey(256, 1, [](int column, int) { return column; }));
  const auto share = [&](const std::string& cutoff) {
    return square(folder, "map_d ramp.png\n" + cutoff).materials.at(0).mask->opaque_share();
  };
  EXPECT_EQ(share(""), 0.5);
  EXPECT_EQ(share("# alpha_cutoff 0.2\n"), 205.0 / 256) << "51 of 255 and more";
  const Mesh mesh = square(folder, "map_d ramp.png\n# alpha_cutoff 0.2\n");
  write_obj(folder.path() / "again.obj", mesh);
  EXPECT_EQ(import_mesh(folder.path() / "again.obj").materials.at(0).mask->opaque_share(),
            205.0 / 256);
}

// A triangle in glTF whose texture is leaf.png.
std::string gltf(const std::string& material) {
  // Positions (0 0 0), (1 0 0), (0 1 0) and texture coordinates (0 0), (1 0), (0 1), as floats.
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
  "materials": [{"name": "leaf", )" +
         material +
         R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
  "textures": [{"source": 0}], "images": [{"uri": "leaf.png"}],
  "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
         "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
         R"("}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
     "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})";
}

TEST(Mask, OfGltfIsAsItsAlphaModeSays) {
  const TemporaryFolder folder;
  folder.write("leaf.png", png_of_alpha(256, 1, [](int column, int) { return column; }));
  const auto mask = [&](const std::string& material) {
    return import_mesh(folder.write("m.gltf", gltf(material))).materials.at(0).mask;
  };
  EXPECT_EQ(mask(""), nullptr) << "opaque is the default";
  EXPECT_EQ(mask(R"("alphaMode": "OPAQUE", )"), nullptr);
  ASSERT_NE(mask(R"("alphaMode": "MASK", )"), nullptr);
  EXPECT_EQ(mask(R"("alphaMode": "MASK", )")->opaque_share(), 0.5);
  EXPECT_EQ(mask(R"("alphaMode": "MASK", "alphaCutoff": 0.2, )")->opaque_share(), 205.0 / 256);
  EXPECT_EQ(mask(R"("alphaMode": "BLEND", )")->opaque_share(), 0.5);
}

TEST(Mask, ThatCannotBeReadIsSaid) {
  const TemporaryFolder folder;
  folder.write("mask.tga", "not what is read");
  std::vector<std::string> notes;
  EXPECT_EQ(square(folder, "map_d mask.tga\n", &notes).materials.at(0).mask, nullptr);
  EXPECT_EQ(square(folder, "map_d missing.png\n", &notes).materials.at(0).mask, nullptr);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("mask.tga is neither PNG nor JPEG"),
                                 HasSubstr("missing.png is no file")));
}

TEST(Mask, ThatIsBrokenOrTooLargeIsRefusedByName) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& bytes) {
    folder.write("mask.png", bytes);
    return message_of<InputError>([&] { square(folder, "map_d mask.png\n"); });
  };
  const std::string png = png_of_alpha(64, 64, [](int column, int row) { return column ^ row; });
  const std::string jpeg = jpeg_of_grey(64, 64, [](int column, int row) { return column ^ row; });
  for (const std::string& whole : {png, jpeg}) {
    EXPECT_THAT(refusal(whole.substr(0, whole.size() / 2)), HasSubstr("mask.png: is not a sound"));
    EXPECT_THAT(refusal(whole.substr(0, 20)), HasSubstr("mask.png: is not a sound"));
  }
  // The width in the header, which a checksum follows: whatever libpng minds first, it is refused.
  std::string huge = png;
  huge[16] = '\x70';
  EXPECT_THAT(refusal(huge), HasSubstr("mask.png: "));
  const std::string wide = png_of_grey(70000, 1000, [](int, int) { return 0; });
  EXPECT_THAT(refusal(wide), HasSubstr("mask.png: has 70000 x 1000 pixels; at most 67108864"));
}

}  // namespace
}  // namespace plotscan::mesh
