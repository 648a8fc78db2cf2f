// SPDX-License-Identifier: Apache-2.0
#include "cloud_options.h"

#include "core/coordinate_units.h"

namespace plotscan {
namespace {

void declare_recording(CLI::App& command, CloudArguments& arguments) {
  RecordingOptions& recording = arguments.cloud.recording;
  const std::string group = "recordings";
  command
      .add_option("--trajectory", recording.trajectory,
                  "of a pcap: where the drone was, TUM text or trajectory.csv, from the "
                  "recording's beginning on, in metres; bags and MCAP files hold their own")
      ->group(group);
  command
      .add_option("--mount", arguments.mount_deg,
                  "of a pcap: the sensor in the body's frame, roll,pitch,yaw in degrees (default: "
                  "0,90,0)")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  command
      .add_option("--sensor", recording.sensor,
                  "of a pcap: a shipped sensor's name or the file of your own (default: as the "
                  "packets tell)")
      ->group(group);
  command
      .add_option("--topic", recording.topic,
                  "of a bag or MCAP: the topic of its clouds (default: /velodyne_points, or the "
                  "only one)")
      ->group(group);
}

void declare_frame(CLI::App& command, CloudArguments& arguments) {
  command
      .add_option("--units", arguments.units,
                  "unit of the cloud's coordinates (default: what the file states, else metres)")
      ->check(CLI::IsMember(unit_symbols()));
  command.add_option("--crs", arguments.cloud.crs,
                     "coordinate system of the cloud: EPSG:CODE of UTM in metres (EPSG:32617) or "
                     "of longitude and latitude (EPSG:4326) (default: what the file states)");
  declare_recording(command, arguments);
}

}  // namespace

void declare_cloud(CLI::App& command, CloudArguments& arguments) {
  command
      .add_option("CLOUD", arguments.cloud.files,
                  "PCD, PLY, LAS or text clouds, a scan folder (its cloud.pcd), a folder of tiles, "
                  "or a recording (pcap, bag, MCAP); several are read as one")
      ->required();
  declare_frame(command, arguments);
}

void declare_shown_cloud(CLI::App& command, CloudArguments& arguments) {
  command
      .add_option("--cloud", arguments.cloud.files,
                  "the cloud that was measured, as estimator run takes it; may be repeated: its "
                  "points are shown")
      ->allow_extra_args(false);
  declare_frame(command, arguments);
  for (const char* told : {"--units", "--crs", "--trajectory", "--mount", "--sensor", "--topic"})
    command.get_option(told)->needs("--cloud");
}

CloudFiles cloud_of(const CloudArguments& arguments) {
  CloudFiles cloud = arguments.cloud;
  if (const auto unit_m = unit_named(arguments.units)) cloud.units = {*unit_m, *unit_m};
  if (!arguments.mount_deg.empty())
    cloud.recording.mount_rpy_deg = Eigen::Vector3d(arguments.mount_deg.data());
  return cloud;
}

}  // namespace plotscan
