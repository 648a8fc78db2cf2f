// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/random.h"
#include "crop/cultivar.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// A leaf on its petiole.
struct SoybeanLeaf {
  Eigen::Vector3d node;
  double azimuth_rad = 0;
  double length_m = 0;  // of the terminal leaflet, or of the unifoliolate blade
  double petiole_m = 0;
  double petiole_angle_rad = 0;  // from the vertical
  double petiole_radius_m = 0;
  const char* material = "leaf";
};

// The organs that a soybean's nodes bear. All draw the same random numbers in both details.
class SoybeanOrgans {
 public:
  SoybeanOrgans(const Traits& traits, PlantBuilder& plant) : traits_(traits), plant_(plant) {}

  // A pair, the first towards the azimuth.
  void cotyledons(const Eigen::Vector3d& node, double azimuth_rad);
  // One of the simple leaves of node 1.
  void unifoliolate(const SoybeanLeaf& leaf, RandomStream& random);
  void trifoliolate(const SoybeanLeaf& leaf, RandomStream& random);
  // A cluster of one to five about the axil; `length_m` is a pod's mean length.
  void pods(const Eigen::Vector3d& axil, double azimuth_rad, double length_m, RandomStream& random);
  void flowers(const Eigen::Vector3d& axil, double azimuth_rad, RandomStream& random);

 private:
  Eigen::Vector3d petiole(const SoybeanLeaf& leaf, RandomStream& random);
  void stalk(const std::vector<Eigen::Vector3d>& path, double radius_m);
  void leaflet(const Eigen::Vector3d& base, double azimuth_rad, double length_m,
               double width_factor, const char* material, RandomStream& random);
  void pod(const Eigen::Vector3d& axil, double azimuth_rad, double elevation_rad, double length_m);

  const Traits& traits_;
  PlantBuilder& plant_;
};

}  // namespace plotscan::crop
