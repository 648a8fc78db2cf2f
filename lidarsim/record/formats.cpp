// SPDX-License-Identifier: Apache-2.0
#include "record/formats.h"

#include "core/contains.h"
#include "core/text.h"
#include "record/internal/las_file.h"
#include "record/ros/recorder.h"
#include "record/ros/ros_points.h"
#include "record/velodyne/pcap_format.h"
#include "scan/cloud_writer.h"

namespace plotscan::record {
namespace {

using std::filesystem::path;

// Opens a cloud; its format is recognised by its content.
Source open_cloud(const path& file, const ReadOptions& options) {
  const scan::CloudInfo info = scan::read_cloud_info(file);
  return {
      .path = file,
      .info = info,
      .flight = options.flight,
      .stream = [=](const scan::PointSink& sink) { return scan::read_points(file, info, sink); }};
}

scan::CloudWriteOptions cloud_options(const Source& source, const WriteOptions& options) {
  return {.ascii = options.encoding == "ascii",
          .origin_m = source.info.origin_m,
          .labels = options.labels};
}

std::unique_ptr<scan::PointWriter> create_pcd(const path& file, const Source& source,
                                              const WriteOptions& options) {
  if (options.encoding == "compressed")
    return std::make_unique<scan::CompressedPcdWriter>(file, source.info.origin_m, options.labels);
  return std::make_unique<scan::PcdWriter>(file, cloud_options(source, options));
}

std::unique_ptr<scan::PointWriter> create_ply(const path& file, const Source& source,
                                              const WriteOptions& options) {
  return std::make_unique<scan::PlyWriter>(file, cloud_options(source, options));
}

// Opens a bag or an MCAP file; which one is recognised by its content.
Source open_ros(const path& file, const ReadOptions& options) {
  const auto recorded = std::make_shared<RosPoints>(file, options.topic);
  return {.path = file,
          .info = {.points = recorded->points(),
                   .origin_m = recorded->origin_m(),
                   .start = recorded->start(),
                   .fields = recorded->fields()},
          .flight = options.flight,
          .trajectory = recorded->trajectory(),
          .stream = [recorded](const scan::PointSink& sink) { return recorded->stream(sink); },
          .notes = recorded->notes()};
}

// Only a scan folder knows how the drone truly moved, and has points that are shots of the flight.
std::unique_ptr<scan::PointWriter> create_ros(const Source& source,
                                              const RosRecorder::CreateFile& create) {
  RosRecorderOptions options{.packets = std::filesystem::is_directory(source.path),
                             .origin_m = source.info.origin_m};
  if (options.packets) options.motion = scan::read_trajectory(source.path / "trajectory.csv");
  return std::make_unique<RosRecorder>(*source.flight, options, create);
}

// `create_file` makes the file with its topics.
template <class CreateFile>
Format ros_format(const std::string& name, const std::string& extension, CreateFile create_file) {
  return {.name = name,
          .extensions = {extension},
          .is_recording = true,
          .has_topics = true,
          .needs_flight = true,
          .open = open_ros,
          .create = [=](const path& file, const Source& source, const WriteOptions&) {
            return create_ros(source, [&](auto topics) { return create_file(file, topics); });
          }};
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {.name = "PCD cloud",
       .extensions = {".pcd"},
       .encodings = {"binary", "compressed", "ascii"},
       .open = open_cloud,
       .create = create_pcd},
      {.name = "PLY cloud",
       .extensions = {".ply"},
       .encodings = {"binary", "ascii"},
       .open = open_cloud,
       .create = create_ply},
      {.name = "LAS cloud",
       .extensions = {".las"},
       .has_crs = true,
       .open = open_cloud,
       .create = create_las},
#ifdef PLOTSCAN_HAVE_LASZIP
      {.name = "LAZ cloud",
       .extensions = {".laz"},
       .has_crs = true,
       .open = open_cloud,
       .create = create_laz},
#endif
#ifdef PLOTSCAN_HAVE_PCAP
      pcap_format(),
      pcapng_format(),
#endif
      ros_format("ROS 1 bag", ".bag", ros::create_bag),
      ros_format("ROS 2 MCAP", ".mcap", ros::create_mcap),
  };
  return all;
}

std::vector<std::string> extensions_of(bool (*wanted)(const Format&)) {
  std::vector<std::string> extensions;
  for (const Format& format : formats()) {
    if (wanted(format))
      extensions.insert(extensions.end(), format.extensions.begin(), format.extensions.end());
  }
  return extensions;
}

std::string readable_clouds() {
  return joined(extensions_of([](const Format& format) {
                  return format.open != nullptr && !format.is_recording;
                }),
                ", ") +
         ", text";
}

const Format* find_format(const path& file) {
  const std::string extension = lower_extension(file);
  for (const Format& format : formats())
    if (contains(format.extensions, extension)) return &format;
  return nullptr;
}

}  // namespace plotscan::record
