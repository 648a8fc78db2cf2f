// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "description/load_description.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "gazebo/export_world.h"
#include "planting/generate.h"
#include "temporary_folder.h"

namespace plotscan::gazebo {

// A leaf of two triangles, open, and a stem of four, closed.
inline constexpr const char* kBush =
    "mtllib bush.mtl\n"
    "v 0 0 0.3\nv 0.2 0 0.4\nv 0.2 0.1 0.4\nv 0 0.1 0.35\n"
    "v -0.02 -0.02 0\nv 0.02 -0.02 0\nv 0 0.02 0\nv 0 0 0.3\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl leaf\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
    "usemtl stem\nf 5/1 7/3 6/2\nf 5/1 6/2 8/4\nf 6/2 7/3 8/4\nf 7/3 5/1 8/4\n";
inline constexpr const char* kBushMaterials =
    "newmtl leaf\nKd 0.2 0.5 0.1\nmap_Kd leaf.png\nnewmtl stem\nKd 0.4 0.4 0.2\n";
// Its leaf is called as the bush's, but looks different.
inline constexpr const char* kThistle =
    "mtllib thistle.mtl\nv 0 0 0\nv 0.1 0 0.1\nv 0 0.1 0.15\nusemtl leaf\nf 1 2 3\n";
inline constexpr const char* kThistleMaterials = "newmtl leaf\nKd 0.3 0.4 0.3\n";

// 1 x 1 pixel.
inline std::string png() {
  static constexpr unsigned char kBytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x08,
      0xd7, 0x63, 0xf8, 0xcf, 0xc0, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0x18, 0xdd, 0x8d,
      0xb0, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

// A farm folder with bushes and thistles in two rows of plots: every fifth plant is a weed, every
// seventh leans, and three stand outside the plots.
class ExportExample {
 public:
  ExportExample() {
    folder_.write("bush.obj", kBush);
    folder_.write("bush.mtl", kBushMaterials);
    folder_.write("leaf.png", png());
    folder_.write("thistle.obj", kThistle);
    folder_.write("thistle.mtl", kThistleMaterials);
    farmfolder::write_farm(
        planting::generate(description::load_description(folder_.write("example.yaml", text())), 5),
        farm_folder(), {.command = "test"});
    farm_ = std::make_unique<farm::Farm>(farmfolder::read_farm(farm_folder()));
    for (farm::Plant& plant : farm_->plants) {
      if (plant.id % 5 == 0) plant.kind = farm::PlantKind::weed;
      if (plant.id % 7 == 0)
        plant.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
      if (plant.id > farm_->plants.size() - 3) plant.plot = 0;
    }
    farm_->anchor = {.latitude_deg = 37.2, .longitude_deg = -80.6, .altitude_m = 600};
  }

  static std::string text() {
    return "terrain: {side_m: 20, vertices: 40, relief_m: 0.4}\n"
           "plots: {width_m: 1.5, length_m: 3, gap_width_m: 0.5, gap_length_m: 1, heading_deg: "
           "30,\n"
           "        rows: [{plots: 2}, {plots: 1}]}\n"
           "plants: {count: 10, scale: [0.8, 1.2], models: [bush.obj, thistle.obj]}\n";
  }

  std::filesystem::path farm_folder() const { return folder_.path() / "farm"; }
  std::filesystem::path path() const { return folder_.path(); }
  const farm::Farm& farm() const { return *farm_; }

  ExportSummary write(const std::string& name, const ExportOptions& options) const {
    return export_world(*farm_, farm_folder(), path() / name, options, {.command = "test"});
  }

 private:
  testing::TemporaryFolder folder_;
  std::unique_ptr<farm::Farm> farm_;
};

}  // namespace plotscan::gazebo
