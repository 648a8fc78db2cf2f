// SPDX-License-Identifier: Apache-2.0
#include "gazebo/readme.h"

#include "core/manifest.h"
#include "core/text_file.h"

namespace plotscan::gazebo {
namespace {

constexpr const char* kOpenClassic = R"md(
Gazebo Classic 9 or 11, from this folder:

    GAZEBO_MODEL_PATH="$PWD/models:$GAZEBO_MODEL_PATH" gazebo world.sdf

Started with ROS, the variable has to be set as well; `gzserver world.sdf` runs without a window.
)md";

constexpr const char* kOpenSim = R"md(
Gazebo Garden, Harmonic, Ionic or Jetty, from this folder:

    GZ_SIM_RESOURCE_PATH="$PWD/models" gz sim world.sdf

Gazebo Fortress, which calls its plugins by other names:

    IGN_GAZEBO_RESOURCE_PATH="$PWD/models" ign gazebo world_fortress.sdf

With `-s -r` behind it Gazebo runs without a window.
)md";

constexpr const char* kFolder = R"md(
| | |
| --- | --- |
| `models/` | the models that the world includes as `model://NAME`, and one model for each plant mesh |
| `truth/` | what is where: plots.geojson, plants.csv, terrain.ply |
| `manifest.json` | command, options, seed and version that made this folder, and the hash of every file |

Metres, x east, y north, z up, origin at the farm's centre.

## Classes

| class | `laser_retro`, label |
| --- | --- |
| ground | 1 |
| crop | 2 |
| weed | 3 |
| other (the drone) | 4 |
)md";

constexpr const char* kDrone = R"md(
## Drone

`drone` carries a VLP-16 at its origin, its spin axis along x as on Plotscan's own drone, and an IMU.
Once the world is open,

    ./fly_drone.sh TRAJECTORY.csv

moves it along the `trajectory.csv` of a scan, one turn of the lidar a pose; `./fly_drone.sh -h` tells more.
)md";

const char* merged_text(Merge merge) {
  switch (merge) {
    case Merge::plot:
      return "Plot N is the model `plot_N`, its weeds are `plot_N_weeds`; a mesh holds all its "
             "surfaces of "
             "one material.";
    case Merge::row:
      return "Row M is the model `row_M`, its weeds are `row_M_weeds`; plot N is its link "
             "`plot_N`, with a "
             "mesh for each material.";
    case Merge::none:
      return "Plant M of plot N is the model `plot_N_plant_M`.";
  }
  return "";
}

}  // namespace

void write_readme(const std::filesystem::path& path, const farm::Farm& farm,
                  const ExportOptions& options, const EntityCounts& counts) {
  const bool classic = options.gazebo == Gazebo::classic;
  TextFile out(path);
  out << "# " << farm.name << "\n\nA farm of " << farm.plots.size() << " plots and "
      << farm.plants.size() << " plants, exported by Plotscan " << version() << ": "
      << counts.models << " models with " << counts.links << " links, " << counts.visuals
      << " visuals and " << counts.triangles << " triangles.\n\n## Opening it\n"
      << (classic ? kOpenClassic : kOpenSim) << "\n## What is here\n"
      << kFolder << "\n"
      << merged_text(options.merge) << "\n";
  if (!classic) {
    out << "\nThe label is what segmentation and bounding box cameras see (the plugin Label, at "
           "each "
           "model).\n";
  }
  if (options.drone) out << kDrone;
  out.close();
}

}  // namespace plotscan::gazebo
