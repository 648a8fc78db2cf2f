// SPDX-License-Identifier: Apache-2.0
#include "record/open_source.h"

#include <algorithm>
#include <utility>

#include "core/angle.h"
#include "core/error.h"
#include "core/utc_time.h"
#include "record/scan_folder.h"
#include "scan/trajectory.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStart = "2026-06-01T10:00:00Z";

UtcTime parsed_start(const std::string& start_utc) {
  const auto start = parse_utc(start_utc);
  if (!start)
    throw InputError("--start \"" + start_utc + "\" must be like " + std::string(kStart) +
                     ", from 1980 to 2099");
  return *start;
}

FlightRecord flight_record(const FlightOptions& options) {
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor.value_or("vlp16"));
  scan::Trajectory reported = scan::read_trajectory(*options.trajectory);
  scan::require_flight_time(*options.trajectory, reported);
  return {.sensor = sensor,
          .spin_hz = sensor::chosen_spin_hz(sensor, options.spin_hz),
          .body_from_lidar = mount_pose(options.mount_rpy_deg.unaryExpr(&radians)),
          .reported = std::move(reported),
          .start = parsed_start(options.start_utc.value_or(kStart))};
}

std::optional<FlightRecord> told_flight(const SourceOptions& options) {
  if (!options.flight) return std::nullopt;
  if (!options.flight->trajectory)
    throw InputError(
        "--sensor, --spin, --mount and --start tell of a flight only with --trajectory");
  return flight_record(*options.flight);
}

Source open_scan_folder(const fs::path& folder, const SourceOptions& options) {
  if (options.flight)
    throw InputError(folder,
                     "is a scan folder, which says by itself what --trajectory, --sensor, "
                     "--spin, --mount and --start are for");
  if (!options.topic.empty())
    throw InputError(folder, "--topic is for bags and MCAP files; a scan folder has no topics");
  const FlightRecord flight = read_flight_record(folder);
  Source source = find_format("cloud.pcd")->open(folder / "cloud.pcd", {.flight = flight});
  source.path = folder;
  if (source.info.start) source.info.start = flight.start;
  return source;
}

// Moves the trajectory into the frame of the points, whose origin is info.origin_m.
void make_relative(Source& source) {
  if (!source.flight || source.info.origin_m.isZero()) return;
  source.flight->reported = scan::moved(source.flight->reported, -source.info.origin_m);
}

// Shifts times so that the trajectory begins at 0 and the points' times count from there.
void count_from_first_pose(Source& source, bool is_recording, bool start_is_told) {
  if (!source.flight) return;
  FlightRecord& flight = *source.flight;
  const double begin_s = flight.reported.start_s();
  flight.reported = scan::delayed(flight.reported, -begin_s);
  if (is_recording) {
    flight.start = source.info.start.value_or(flight.start);
    return;
  }
  if (start_is_told || source.info.start)
    flight.start = later(start_is_told ? flight.start : *source.info.start, begin_s);
  source.info.start = flight.start;
  if (begin_s == 0 || std::ranges::count(source.info.fields, "time") == 0) return;
  source.stream = [stream = source.stream, begin_s](const scan::PointSink& sink) {
    std::vector<scan::LabelledPoint> counted;
    stream([&](std::span<const scan::LabelledPoint> points) {
      counted.assign(points.begin(), points.end());
      for (scan::LabelledPoint& point : counted) point.time -= begin_s;
      sink(counted);
    });
  };
}

}  // namespace

Source open_source(const fs::path& in, const SourceOptions& options) {
  if (fs::is_directory(in)) return open_scan_folder(in, options);
  require_file(in);
  const Format* format = find_format(in);
  // Without a known extension it is read as a cloud, which is recognised by its content.
  if (format == nullptr) format = find_format("cloud.pcd");
  if (!format->open) throw InputError(in, "a " + format->name + " is written, but not read");
  if (!options.topic.empty() && !format->has_topics)
    throw InputError(in,
                     "--topic is for bags and MCAP files; a " + format->name + " has no topics");
  Source source =
      format->open(in, {.flight = told_flight(options),
                        .sensor_told = options.flight && options.flight->sensor.has_value(),
                        .topic = options.topic});
  make_relative(source);
  count_from_first_pose(source, format->is_recording,
                        options.flight && options.flight->start_utc.has_value());
  return source;
}

}  // namespace plotscan::record
