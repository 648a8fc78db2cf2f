// SPDX-License-Identifier: Apache-2.0
#include "core/manifest.h"
#include "core/text_file.h"
#include "gazebo/internal/world_file.h"

namespace plotscan::gazebo {
namespace {

constexpr const char* kOpenClassic = R"md(
Gazebo Classic 9 or 11, from this folder:

    GAZEBO_MODEL_PATH="$PWD/models:$GAZEBO_MODEL_PATH" gazebo world.sdf

Started with ROS, the variable has to be set as well; `gzserver world.sdf` runs without a window.
)md";

constexpr const char* kSlowMerge = R"md(
Every plant is a model of its own: 2,700 of them load in 8 s, take 4 GB and run at 1.5 % of real time, where the same
plants merged by plot run in real time.
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

constexpr const char* kSimTopics = R"md(
Topics: `vlp16`, its points `vlp16/points`, `imu`, and `navsat` on farms with an anchor.
)md";

constexpr const char* kClassicFlight = R"md(
It takes the drone out and puts it back as an actor, which Gazebo moves by itself in real time: it stands at the first
pose for a second and then holds each for a turn. The script prints the simulated time of the first and the last pose;
the others follow a turn (0.1 s) upon another, and the scan of each is stamped up to 20 ms later. A scan tells its pose,
`world_pose`. While the world is paused the lidar publishes a stamp again and again, the first time without the plants
or at an older pose: recorders keep the last scan of a stamp.

Where drawing a scan takes longer than 50 ms (no graphics card, or a large world), start `gzserver --lockstep world.sdf`
and give `gz physics -u 200` before the flight: at a fifth of real time, each scan then has its pose.

| topic | |
| --- | --- |
)md";

constexpr const char* kGpuRay = R"md(
The lidar sees what is drawn. A machine without a display needs one: `xvfb-run -s "-screen 0 1280x1024x24" gzserver
world.sdf`, or an export with `--lidar cpu --collision mesh`.
)md";

constexpr const char* kCpuRay = R"md(
The lidar meets collisions, and needs neither display nor graphics card.
)md";

void write_classic_drone(TextFile& out, const farm::Farm& farm, Lidar lidar) {
  const std::string topics = "| `/gazebo/" + farm.name + "/drone/base_link/";
  out << kClassicFlight << topics << "vlp16/scan` | the lidar, frame `drone::base_link` |\n"
      << topics << "imu/imu` | the IMU |\n";
  if (farm.anchor) out << topics << "gps/navsat` | the GPS receiver |\n";
  out << (lidar == Lidar::cpu ? kCpuRay : kGpuRay);
}

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
  if (options.merge == Merge::none) out << kSlowMerge;
  if (options.drone) {
    out << kDrone;
    if (classic)
      write_classic_drone(out, farm, options.lidar);
    else
      out << kSimTopics;
  }
  out.close();
}

}  // namespace plotscan::gazebo
