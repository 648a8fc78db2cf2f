// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/textures.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "core/error.h"
#include "crop/plant_builder.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"
#include "temporary_folder.h"

namespace plotscan::crop {
namespace {

const Eigen::Vector3f kGreen(0.25F, 0.48F, 0.16F);

struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  // x from the left, y from the upper edge
  Eigen::Vector3f at(int x, int y) const {
    const std::uint8_t* pixel = &rgb[static_cast<std::size_t>(3 * (y * width + x))];
    return Eigen::Vector3f(pixel[0], pixel[1], pixel[2]) / 255;
  }
  // Red and green and blue, mean over rows [from, to) of one column, shares of width and height.
  double column(double u, double from, double to) const {
    double sum = 0;
    int count = 0;
    for (int y = static_cast<int>(from * height); y < static_cast<int>(to * height); ++y, ++count)
      sum += at(static_cast<int>(u * width), y).mean();
    return sum / count;
  }
};

Pixels decoded(const mesh::Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&png, image.bytes.data(), image.bytes.size()), 0);
  png.format = PNG_FORMAT_RGB;
  Pixels pixels{.width = static_cast<int>(png.width),
                .height = static_cast<int>(png.height),
                .rgb = std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  EXPECT_NE(png_image_finish_read(&png, nullptr, pixels.rgb.data(), 0, nullptr), 0);
  return pixels;
}

Eigen::Vector3f mean_of(const Pixels& pixels) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) sum += pixels.at(x, y);
  }
  return sum / static_cast<float>(pixels.width * pixels.height);
}

std::shared_ptr<const mesh::Image> leaf_texture(Form form, const Eigen::Vector3f& colour) {
  return organ_texture(form, "reed", "leaf", colour);
}

TEST(Textures, HaveTheOrgansColourOnTheWhole) {
  for (const auto& [form, material] :
       std::vector<std::pair<Form, std::string>>{{Form::soybean, "leaf"},
                                                 {Form::soybean, "stem"},
                                                 {Form::soybean, "pod"},
                                                 {Form::wheat, "leaf"},
                                                 {Form::wheat, "ear"},
                                                 {Form::maize, "leaf"},
                                                 {Form::maize, "husk"},
                                                 {Form::maize, "tassel"}}) {
    const auto image = organ_texture(form, "reed", material, kGreen);
    const Pixels pixels = decoded(*image);
    EXPECT_LT((mean_of(pixels) - kGreen).cwiseAbs().maxCoeff(), 0.06F) << material;
    EXPECT_LT(image->bytes.size(), 40'000u) << material;
    EXPECT_EQ(image->name, "reed_" + material + "_407a29.png");
  }
}

TEST(Textures, AreTheSameBytesEveryTimeAndOthersForOtherColours) {
  EXPECT_EQ(leaf_texture(Form::soybean, kGreen)->bytes, leaf_texture(Form::soybean, kGreen)->bytes);
  const auto yellow = leaf_texture(Form::soybean, {0.7F, 0.65F, 0.2F});
  EXPECT_NE(yellow->name, leaf_texture(Form::soybean, kGreen)->name);
  EXPECT_NE(yellow->bytes, leaf_texture(Form::soybean, kGreen)->bytes);
  EXPECT_EQ(yellow->bytes.find("tIME"), std::string::npos);
}

TEST(Textures, AMidribIsLighterThanTheLeaf) {
  for (const Form form : {Form::soybean, Form::wheat, Form::maize}) {
    const Pixels pixels = decoded(*leaf_texture(form, kGreen));
    const int place = static_cast<int>(form);
    EXPECT_GT(pixels.column(0.5, 0.3, 1), pixels.column(0.3, 0.3, 1) + 0.1) << place;
    EXPECT_GT(pixels.column(0.5, 0.3, 1), pixels.column(0.7, 0.3, 1) + 0.1) << place;
  }
}

// Mean step from a pixel to its neighbour across and along the leaf, beside the midrib.
std::pair<double, double> steps(const Pixels& pixels) {
  double across = 0;
  double along = 0;
  for (int y = 1; y < pixels.height; ++y) {
    for (int x = 1; x < pixels.width * 2 / 5; ++x) {
      across += std::abs(pixels.at(x, y).mean() - pixels.at(x - 1, y).mean());
      along += std::abs(pixels.at(x, y).mean() - pixels.at(x, y - 1).mean());
    }
  }
  return {across, along};
}

TEST(Textures, VeinsRunAlongGrassBladesAndAsideInSoybeanLeaflets) {
  const auto [across_grass, along_grass] = steps(decoded(*leaf_texture(Form::maize, kGreen)));
  EXPECT_GT(across_grass, 4 * along_grass);
  const auto [across_bean, along_bean] = steps(decoded(*leaf_texture(Form::soybean, kGreen)));
  EXPECT_LT(across_bean, 2 * along_bean);
}

TEST(Textures, GoByTheFormThatDrawsTheCrop) {
  EXPECT_EQ(pattern_of(Form::wheat, "ripe_ear"), Pattern::spikelets);
  EXPECT_EQ(pattern_of(Form::soybean, "yellow_leaf"), Pattern::net_veins);
  EXPECT_EQ(pattern_of(Form::soybean, "pod"), Pattern::pod);
  for (const Form grass : {Form::wheat, Form::maize})
    EXPECT_EQ(pattern_of(grass, "leaf"), Pattern::parallel_veins);
  const auto barley = organ_texture(Form::wheat, "barley", "ear", kGreen);
  EXPECT_EQ(barley->bytes, organ_texture(Form::wheat, "wheat", "ear", kGreen)->bytes);
  EXPECT_EQ(barley->name, "barley_ear_407a29.png");
}

TEST(Textures, APlantKeepsThemInItsFile) {
  PlantBuilder plant(Detail::light, {{"leaf", kGreen}, {"stem", {0.3F, 0.4F, 0.2F}}});
  plant.tube({.path = {{0, 0, 0}, {0, 0, 0.3}}, .radius_m = {0.004, 0.003}}, "stem");
  plant.blade({.midrib = {{0, 0, 0.3}, {0.05, 0, 0.32}, {0.1, 0, 0.3}},
               .half_width_m = {0, 0.03, 0},
               .across = {{0, 1, 0}}},
              "leaf");
  mesh::Mesh mesh = plant.take(true);
  add_textures(mesh, Form::soybean, "soybean");
  const testing::TemporaryFolder folder;
  mesh::write_obj(folder.path() / "plant.obj", mesh);
  const mesh::Mesh read = mesh::import_mesh(folder.path() / "plant.obj");
  ASSERT_EQ(read.materials.size(), 2u);
  for (const mesh::Material& material : read.materials) {
    ASSERT_NE(material.texture, nullptr);
    EXPECT_EQ(material.colour, Eigen::Vector3f::Ones());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / material.texture->name));
  }
  EXPECT_EQ(read.materials[0].texture->bytes, mesh.materials[0].texture->bytes);
}

}  // namespace
}  // namespace plotscan::crop
