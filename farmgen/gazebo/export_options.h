// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::gazebo {

enum class Gazebo {
  classic,  // Gazebo Classic 9 and 11: SDF 1.6
  sim,      // Gazebo Sim, Fortress to Jetty: SDF 1.9
};

// What becomes one static model. Gazebo takes minutes to load thousands of models.
enum class Merge {
  plot,  // all plants of a plot, one mesh a material
  row,   // the plots of a row, one link each, and again one mesh a material
  none,  // every plant: a mesh that all plants of a kind share, scaled
};

enum class Detail {
  light,  // farm::PlantModel::light where there is one, else simplified to kLightTriangles
  scan,   // the meshes that lidarsim scans
};

enum class Collision {
  none,  // plants can be flown and driven through; the terrain always collides
  box,   // one box around a plot's canopy, or with Merge::none around each plant
  mesh,  // the surfaces themselves
};

// What the drone's lidar sees in Gazebo Classic. Gazebo Sim has only `gpu`.
enum class Lidar {
  gpu,  // what is drawn: needs a display, without a graphics card slow
  cpu,  // collisions: needs no display, meets the meshes of Collision::mesh to a tenth of a
        // millimetre
};

struct ExportOptions {
  Gazebo gazebo = Gazebo::sim;
  Merge merge = Merge::plot;
  Detail lod = Detail::light;
  Collision collision = Collision::none;
  bool drone = false;  // a quadrotor with a VLP-16, and a script that flies it
  Lidar lidar = Lidar::gpu;
  int threads = 1;
  bool replace = false;  // a world that is there
};

// The triangles of a light plant that has no light mesh of its own.
inline constexpr int kLightTriangles = 300;

}  // namespace plotscan::gazebo
