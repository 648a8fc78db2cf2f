// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/plant_visuals.h"

#include <gtest/gtest.h>

namespace plotscan::farmfolder {
namespace {

// Plants of both kinds and two models that stand, lean or hang, scaled and not.
std::vector<farm::Plant> plants() {
  std::vector<farm::Plant> plants;
  for (std::uint32_t i = 0; i < 24; ++i) {
    farm::Plant& plant = plants.emplace_back();
    plant.id = 1 + 97 * i;
    plant.model = i % 2;
    plant.kind = i % 3 == 0 ? farm::PlantKind::weed : farm::PlantKind::crop;
    plant.position = {0.1 * i, -0.0, -1e-7 * i};
    plant.rotation = Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d(0.1 * (i % 4), 0, 1).normalized());
    if (i % 4 < 3) plant.scale = {1.0 / (1 + i), 1, 2};
  }
  plants.back().rotation = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitY());
  return plants;
}

TEST(PlantVisuals, AreWhatIsPrintedElementByElement) {
  const std::vector<std::string> uris = {"models/plant_1/plant_1.obj", "models/a & b/0 0.obj"};
  constexpr int kDepth = 3;
  const PlantVisuals visuals(uris, kDepth);
  sdfxml::XmlElements elements(kDepth);
  std::string text;
  for (const farm::Plant& plant : plants()) {
    write_plant(elements, plant, uris[plant.model]);
    visuals.append(text, plant);
  }
  EXPECT_EQ(text, elements.printed());
}

}  // namespace
}  // namespace plotscan::farmfolder
