// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "core/geodesy.h"
#include "core/plot_box.h"
#include "mesh/mesh.h"
#include "terrain/terrain.h"

namespace plotscan::farm {

// A plant mesh that is placed many times. Its frame: metres, z up, origin at the stem's base.
struct PlantModel {
  std::string
      name;  // unique in the farm; letters, digits, '-', '_', '.'; names its folder below models/
  mesh::Mesh mesh;
  double height_m = 0;                   // highest vertex over the origin, measured from the mesh
  std::optional<mesh::Mesh> light = {};  // the same plant in few triangles, where there is one
  // What the import of its mesh left out, and what is odd; not stored in the farm's folder.
  std::vector<std::string> notes = {};
};

enum class PlantKind : std::uint8_t { crop, weed };

// One placed plant: world_from_model = translation(position) * rotation * scale.
struct Plant {
  std::uint32_t id = 0;     // from 1, in the order of truth/plants.csv
  std::uint32_t plot = 0;   // Plot::id, 0 for a plant outside every plot
  std::uint32_t model = 0;  // index into Farm::models
  PlantKind kind = PlantKind::crop;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // the stem's base, world frame
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  double height_m = 0;  // highest vertex of the placed mesh minus terrain height at the stem's base
};

// translation(position) * rotation * scale
inline Eigen::Affine3d world_from_plant(const Plant& plant) {
  return Eigen::Translation3d(plant.position) * plant.rotation * Eigen::Scaling(plant.scale);
}

// What grows where no cultivar is named.
inline constexpr std::string_view kNoAccession = "crop";

// The named truths of a plot's height, metres, over its plants' heights (docs/farm-format.md).
struct PlotHeights {
  double mean = 0;
  double max = 0;
  double p50 = 0;
  double p90 = 0;
  double p95 = 0;
  double p99 = 0;
  double hand3 = 0;  // mean of 3 plants drawn at random: the paper's field protocol
};

// Percentiles of a plot's canopy as rays cast straight down see it, metres (docs/farm-format.md).
struct CanopyHeights {
  double p95 = 0;
  double p99 = 0;
};

// A plot, with the facts that a breeder's field book has.
struct Plot {
  std::uint32_t id = 0;                               // the plot number; no two alike
  int trial = 0;                                      // from 1; 0 where the farm is one trial
  int row = 0;                                        // of the trial, from 1
  int column = 0;                                     // from 1, along the row
  PlotBox box;                                        // bounds the sown area
  std::uint32_t plant_count = 0;                      // of the crop: weeds are not counted
  PlotHeights heights;                                // of the crop; all zero without plants
  int rep = 1;                                        // replicate of the cultivar, from 1
  int block = 1;                                      // from 1
  std::string accession = std::string(kNoAccession);  // the cultivar's name
  std::uint32_t missing_plants = 0;                   // sown, but not there
  std::uint32_t weed_count = 0;
  double lodging_rad = 0;                    // mean lean of its plants from the vertical
  std::optional<CanopyHeights> canopy = {};  // absent: not measured (lidar/make_farm.h)
};

// A virtual phenotyping farm, world frame: ENU, metres, z up, origin at the farm's centre.
struct Farm {
  std::string name;
  std::uint64_t seed = 0;
  terrain::Terrain terrain;
  std::vector<PlantModel> models;
  std::vector<Plot> plots;
  std::vector<Plant> plants;
  std::optional<Anchor> anchor = {};  // where on Earth the origin lies, where that is known
  // The origin in the coordinates of the XYZ file that the terrain was made from, where they were
  // shifted.
  std::optional<Eigen::Vector3d> terrain_origin_m = {};
  // Diffuse reflectance of the ground at 903 nm, in [0, 1]; absent: mesh::kSoilReflectance.
  std::optional<double> soil_reflectance = {};
};

}  // namespace plotscan::farm
