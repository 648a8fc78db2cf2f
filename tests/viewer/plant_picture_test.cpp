// SPDX-License-Identifier: Apache-2.0
#include "view/plant_picture.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "temporary_folder.h"
#include "view/internal/plant_layout.h"
#include "viewer/pixels.h"

namespace plotscan::view {
namespace {

const Eigen::Vector3f kRed(0.95F, 0.05F, 0.05F);
const Eigen::Vector3f kBlue(0.05F, 0.05F, 0.95F);

// An upright slab, 0.4 m wide, that faces south.
PicturedPlant slab(const std::string& label, float height_m, const Eigen::Vector3f& colour) {
  return {
      .label = label,
      .mesh = {.vertices = {{-0.2F, 0, 0}, {0.2F, 0, 0}, {0.2F, 0, height_m}, {-0.2F, 0, height_m}},
               .triangles = {{0, 1, 2}, {0, 2, 3}},
               .materials = {{.name = "leaf", .colour = colour, .texture = {}}},
               .triangle_material = {0, 0},
               .texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
}

// Where pixels of a colour lie: the smallest box around them.
struct Patch {
  int left = std::numeric_limits<int>::max();
  int right = -1;
  int bottom = std::numeric_limits<int>::max();
  int top = -1;
  int width() const { return right - left + 1; }
  int height() const { return top - bottom + 1; }
};

Patch patch_of(const std::filesystem::path& png, const std::function<bool(Colour)>& wanted) {
  Patch patch;
  for_pixels(png, [&](int x, int y, const Colour& colour) {
    if (!wanted(colour)) return;
    patch.left = std::min(patch.left, x);
    patch.right = std::max(patch.right, x);
    patch.bottom = std::min(patch.bottom, y);
    patch.top = std::max(patch.top, y);
  });
  return patch;
}

const PlantPictureOptions kFromSouth{
    .width_px = 600, .height_px = 400, .azimuth_deg = -90, .elevation_deg = 0, .columns = 2};

TEST(PlantPicture, PlantsStandSideBySideOnOneLineAtOneScale) {
  const testing::TemporaryFolder folder;
  const auto png = folder.path() / "two.png";
  draw_plants({slab("small", 1, kRed), slab("tall", 2, kBlue)}, png, kFromSouth);
  const Patch small = patch_of(png, red);
  const Patch tall = patch_of(png, blue);
  EXPECT_LT(small.right, tall.left);
  EXPECT_NEAR(small.bottom, tall.bottom, 1);
  EXPECT_GT(tall.height(), 300) << "fills the picture";
  EXPECT_NEAR(tall.height(), 2 * small.height(), 3);
  EXPECT_NEAR(small.height(), 2.5 * small.width(), 4) << "1 m by 0.4 m";
}

TEST(PlantPicture, RowsFollowFromTheTop) {
  const testing::TemporaryFolder folder;
  const auto png = folder.path() / "rows.png";
  PlantPictureOptions options = kFromSouth;
  options.columns = 1;
  draw_plants({slab("first", 1, kRed), slab("second", 1, kBlue)}, png, options);
  EXPECT_GT(patch_of(png, red).bottom, patch_of(png, blue).top);
}

TEST(PlantPicture, FromAboveShowsTheGroundPlan) {
  const testing::TemporaryFolder folder;
  const auto png = folder.path() / "above.png";
  PicturedPlant flat = slab("flat", 1, kRed);
  for (auto& vertex : flat.mesh.vertices) std::swap(vertex.y(), vertex.z());
  PlantPictureOptions options = kFromSouth;
  options.elevation_deg = 90;
  draw_plants({flat}, png, options);
  EXPECT_NEAR(patch_of(png, red).height(), 2.5 * patch_of(png, red).width(), 4);
}

// A PNG of 64 x 64 pixels, red on the left and blue on the right.
std::string two_colours() {
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 64, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      pixel[0] = x < 32 ? 250 : 10;
      pixel[1] = 10;
      pixel[2] = x < 32 ? 10 : 250;
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray& bytes = *writer->GetResult();
  return {reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray&>(bytes).GetPointer(0)),
          static_cast<std::size_t>(bytes.GetNumberOfValues())};
}

TEST(PlantPicture, TexturesLieWhereTheirCoordinatesSay) {
  const testing::TemporaryFolder folder;
  const auto png = folder.path() / "textured.png";
  PicturedPlant plant = slab("leaf", 1, Eigen::Vector3f::Ones());
  plant.mesh.materials[0].texture =
      std::make_shared<mesh::Image>(mesh::Image{"leaf.png", two_colours()});
  draw_plants({plant}, png, kFromSouth);
  const Patch left = patch_of(png, red);
  const Patch right = patch_of(png, blue);
  EXPECT_LT(left.right, right.left + 2);
  EXPECT_NEAR(left.width(), right.width(), 4);
  EXPECT_GT(left.height(), 200);
}

TEST(PlantPicture, RefusesWhatCannotBeDrawn) {
  const testing::TemporaryFolder folder;
  const auto png = folder.path() / "a.png";
  const std::vector<PicturedPlant> one = {slab("one", 1, kRed)};
  EXPECT_THROW(draw_plants({}, png, {}), InputError);
  EXPECT_THROW(draw_plants(one, png, {.width_px = 1}), InputError);
  EXPECT_THROW(draw_plants(one, png, {.elevation_deg = -1}), InputError);
  EXPECT_THROW(draw_plants(one, png, {.columns = -1}), InputError);
  EXPECT_THROW(draw_plants(one, folder.path() / "absent" / "a.png", {}), InputError);
  EXPECT_THROW(draw_plants(std::vector<PicturedPlant>(200, one[0]), png,
                           {.width_px = 100, .height_px = 100}),
               InputError);
  const std::string whole = two_colours();
  for (const std::string& bytes :
       {std::string("\x89PNG\r\n\x1a\n"), whole.substr(0, 40), whole.substr(0, whole.size() / 2),
        std::string("\xff\xd8\xff"), std::string("\xff\xd8\xff\xe0 no picture")}) {
    std::vector<PicturedPlant> broken = one;
    broken[0].mesh.materials[0].texture =
        std::make_shared<mesh::Image>(mesh::Image{"leaf.png", bytes});
    EXPECT_THROW(draw_plants(broken, png, {}), InputError) << bytes.size() << " bytes";
  }
  EXPECT_FALSE(std::filesystem::exists(png));
}

TEST(PlantLayout, TakesTheNumberOfColumnsThatMakesPlantsLargest) {
  const std::vector<PlantExtent> square(
      4, {.left_m = 0.5, .right_m = 0.5, .above_m = 1, .below_m = 0, .label_px = 10});
  EXPECT_EQ(lay_out(square, {2000, 300}, 0).rows.size(), 1u);
  EXPECT_EQ(lay_out(square, {600, 600}, 0).rows.size(), 2u);
  EXPECT_EQ(lay_out(square, {200, 2000}, 0).rows.size(), 4u);
  EXPECT_EQ(lay_out(square, {2000, 300}, 2).rows.size(), 2u);
  EXPECT_GT(lay_out(square, {600, 600}, 0).px_per_m, lay_out(square, {600, 600}, 4).px_per_m);
}

}  // namespace
}  // namespace plotscan::view
