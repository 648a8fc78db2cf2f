// SPDX-License-Identifier: Apache-2.0
#include "record/convert.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/text.h"
#include "core/utc_time.h"
#include "scan/trajectory.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

bool is_trajectory(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".tum" || extension == ".txt" || extension == ".csv";
}

std::string writable_extensions() {
  std::vector<std::string> extensions;
  for (const Format& format : formats())
    if (format.create)
      extensions.insert(extensions.end(), format.extensions.begin(), format.extensions.end());
  extensions.insert(extensions.end(), {".tum", ".txt", ".csv"});
  return joined(extensions, ", ");
}

FlightRecord flight_record(const FlightOptions& options) {
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor);
  const auto start = parse_utc(options.start_utc);
  if (!start)
    throw InputError("--start \"" + options.start_utc + "\" must be like 2026-06-01T10:00:00Z");
  return {.sensor = sensor,
          .spin_hz = sensor::chosen_spin_hz(sensor, options.spin_hz),
          .body_from_lidar = mount_pose(options.mount_rpy_deg * std::numbers::pi / 180),
          .reported = scan::read_trajectory(*options.trajectory),
          .start = *start};
}

std::optional<FlightRecord> told_flight(const ConvertOptions& options) {
  if (!options.flight) return std::nullopt;
  if (!options.flight->trajectory)
    throw InputError(
        "--sensor, --spin, --mount and --start tell of a flight only with --trajectory");
  return flight_record(*options.flight);
}

Source open_scan_folder(const fs::path& folder, const ConvertOptions& options) {
  if (options.flight)
    throw InputError(folder,
                     "is a scan folder, which says by itself what --trajectory, --sensor, "
                     "--spin, --mount and --start are for");
  if (!options.topic.empty())
    throw InputError(folder, "--topic is for bags and MCAP files; a scan folder has no topics");
  const FlightRecord flight = read_flight_record(folder);
  Source source = find_format("cloud.pcd")->open(folder / "cloud.pcd", {.flight = flight});
  source.path = folder;
  source.info.start = flight.start;
  return source;
}

// The trajectory in the frame of the points.
void make_relative(Source& source) {
  if (!source.flight || source.info.origin_m.isZero()) return;
  std::vector<scan::StampedPose> poses = source.flight->reported.poses();
  for (scan::StampedPose& pose : poses) pose.position_m -= source.info.origin_m;
  source.flight->reported = scan::Trajectory(std::move(poses));
}

ConvertSummary write_poses(const scan::Trajectory& trajectory, const fs::path& out) {
  if (out.extension() == ".csv") {
    scan::write_trajectory(out, trajectory);
  } else {
    scan::write_tum(out, trajectory);
  }
  return {.poses = trajectory.poses().size()};
}

// A trajectory's file, or the reported trajectory of a scan folder or a recording.
scan::Trajectory trajectory_of(const fs::path& in, const ConvertOptions& options) {
  if (fs::is_directory(in)) return read_flight_record(in).reported;
  if (is_trajectory(in)) return scan::read_trajectory(in);
  const Source source = open_source(in, options);
  if (source.flight) return source.flight->reported;
  if (source.trajectory) return *source.trajectory;
  throw InputError(in, "holds points but no trajectory");
}

const Format& writable_format(const fs::path& out) {
  const Format* format = find_format(out);
  if (format == nullptr || !format->create) {
    throw InputError(out,
                     "cannot be written: its name must end in one of " + writable_extensions());
  }
  return *format;
}

void require_options(const Format& format, const fs::path& out, const WriteOptions& options) {
  const auto& encodings = format.encodings;
  if (!options.encoding.empty() && std::ranges::count(encodings, options.encoding) == 0) {
    throw InputError(out, "--encoding " + options.encoding + " is none of a " + format.name +
                              (encodings.empty() ? ", which has but one"
                                                 : "; there are " + joined(encodings, ", ")));
  }
  if (!options.crs.empty() && !format.has_crs)
    throw InputError(out, "--crs is for LAS; a " + format.name + " has no coordinate system");
  if (!options.crs.empty() && options.crs != "local" && options.crs != "utm")
    throw InputError(out, "--crs \"" + options.crs + "\" must be local or utm");
}

}  // namespace

Source open_source(const fs::path& in, const ConvertOptions& options) {
  if (fs::is_directory(in)) return open_scan_folder(in, options);
  require_file(in);
  const Format* format = find_format(in);
  // A cloud is known by its content, whatever its name.
  if (format == nullptr) format = find_format("cloud.pcd");
  if (!format->open) throw InputError(in, "a " + format->name + " is written, but not read");
  if (!options.topic.empty() && !format->has_topics)
    throw InputError(in,
                     "--topic is for bags and MCAP files; a " + format->name + " has no topics");
  Source source = format->open(in, {.flight = told_flight(options), .topic = options.topic});
  make_relative(source);
  return source;
}

ConvertSummary write_points(const Source& source, const fs::path& out, const WriteOptions& options,
                            const ProgressReport& progress) {
  const Format& format = writable_format(out);
  require_options(format, out, options);
  if (format.needs_flight && !source.flight) {
    throw InputError(out, "a " + format.name + " needs the flight, of which " +
                              source.path.filename().string() +
                              " says nothing; give a scan folder, or --trajectory FILE (and "
                              "--sensor, --spin, --mount, --start)");
  }
  ConvertSummary summary;
  const auto writer = format.create(out, source, options);
  source.stream([&](std::span<const scan::LabelledPoint> points) {
    writer->write(points);
    summary.points += points.size();
    if (progress && source.info.points > 0)
      progress(std::min(
          1.0, static_cast<double>(summary.points) / static_cast<double>(source.info.points)));
  });
  writer->close();
  return summary;
}

ConvertSummary convert(const fs::path& in, const fs::path& out, const ConvertOptions& options,
                       const ProgressReport& progress) {
  require_apart(out, {{in}});
  return convert_within(in, out, options, progress);
}

ConvertSummary convert_within(const fs::path& in, const fs::path& out,
                              const ConvertOptions& options, const ProgressReport& progress) {
  OutputFile file(out, options.replace);
  if (!fs::is_directory(in)) require_file(in);
  ConvertSummary summary;
  if (is_trajectory(out)) {
    summary = write_poses(trajectory_of(in, options), file.path());
  } else if (is_trajectory(in)) {
    throw InputError(in, "is a trajectory; it is converted to .tum, .txt or .csv");
  } else {
    summary = write_points(open_source(in, options), file.path(), options.write, progress);
  }
  file.commit();
  return summary;
}

}  // namespace plotscan::record
