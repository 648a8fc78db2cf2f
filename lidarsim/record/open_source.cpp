// SPDX-License-Identifier: Apache-2.0
#include "record/open_source.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/contains.h"
#include "core/error.h"
#include "core/setting.h"
#include "core/statistics.h"
#include "core/utc_time.h"
#include "record/scan_folder.h"
#include "scan/trajectory.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

constexpr Range kMountRange_deg = {-360, 360};
constexpr const char* kStart = "2026-06-01T10:00:00Z";

UtcTime parsed_start(const std::string& start_utc) {
  const auto start = parse_utc(start_utc);
  if (!start)
    throw InputError("--start \"" + start_utc + "\" must be like " + std::string(kStart) +
                     ", from 1980 to 2099");
  return *start;
}

FlightRecord flight_record(const FlightOptions& options) {
  require_in_range("--mount", options.mount_rpy_deg, kMountRange_deg);
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor.value_or("vlp16"));
  scan::Trajectory reported = scan::read_trajectory(*options.trajectory);
  scan::require_flight_time(*options.trajectory, reported);
  return {.sensor = sensor,
          .spin_hz = sensor::chosen_spin_hz(sensor, options.spin_hz),
          .body_from_lidar = mount_pose(options.mount_rpy_deg.unaryExpr(&radians)),
          .reported = std::move(reported),
          .start = parsed_start(options.start_utc.value_or(kStart))};
}

std::optional<FlightRecord> given_flight(const SourceOptions& options) {
  if (!options.flight) return std::nullopt;
  if (!options.flight->trajectory)
    throw InputError(
        "--sensor, --spin, --mount and --start tell of a flight only with --trajectory");
  return flight_record(*options.flight);
}

Source open_scan_folder(const fs::path& folder, const SourceOptions& options) {
  const FlightRecord flight = scan_flight(folder, options);
  Source source = find_format("cloud.pcd")->open(folder / "cloud.pcd", {.flight = flight});
  source.path = folder;
  source.of_scan_folder = true;
  if (source.info.start) source.info.start = flight.start;
  return source;
}

// Says where the trajectory has no poses for long; "" where it has no such gap.
std::string gap_note(const fs::path& file, const scan::Trajectory& trajectory) {
  constexpr double kLong_s = 1, kManySteps = 10;
  const std::vector<scan::StampedPose>& poses = trajectory.poses();
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < poses.size(); ++i)
    steps_s.push_back(poses[i].time_s - poses[i - 1].time_s);
  if (steps_s.empty()) return "";
  const auto longest = std::ranges::max_element(steps_s);
  const double gap_s = *longest;
  const double from_s = poses[static_cast<std::size_t>(longest - steps_s.begin())].time_s;
  if (gap_s < std::max(kLong_s, kManySteps * quantile(std::move(steps_s), 0.5))) return "";
  return fmt::format(
      "the trajectory of {} has no pose for {:.1f} s, {:.1f} s after its first: the sensor is "
      "taken "
      "to move straight there",
      file.filename().string(), gap_s, from_s - poses.front().time_s);
}

// What should be known of how the sensor of a recording moved.
std::string motion_note(const Source& source, bool has_transforms) {
  if (source.flight) return gap_note(source.path, source.flight->reported);
  if (source.trajectory) return gap_note(source.path, *source.trajectory);
  if (!has_transforms)
    return "without --trajectory each point lies in the sensor's own frame at its instant";
  return "no transform of " + source.path.filename().string() +
         " moves its clouds: they are taken to stand still in the world";
}

// Leaves out the points from after the trajectory's end: nothing says where the sensor was.
void end_with_trajectory(Source& source) {
  constexpr double kTolerance_s = 0.1;
  if (!source.flight) return;
  const double end_s = source.flight->reported.end_s() + kTolerance_s;
  source.stream = [stream = source.stream, end_s](const scan::PointSink& sink) {
    std::size_t after = 0;
    std::vector<scan::LabelledPoint> flown;
    scan::CloudSummary summary = stream([&](std::span<const scan::LabelledPoint> points) {
      flown.clear();
      std::ranges::copy_if(points, std::back_inserter(flown),
                           [&](const scan::LabelledPoint& point) { return point.time <= end_s; });
      after += points.size() - flown.size();
      if (!flown.empty()) sink(flown);
    });
    summary.points -= after;
    summary.not_finite += after;
    return summary;
  };
}

// Moves the trajectory into the frame of the points, whose origin is info.origin_m.
void make_relative(Source& source) {
  if (!source.flight || source.info.origin_m.isZero()) return;
  source.flight->reported = scan::moved(source.flight->reported, -source.info.origin_m);
}

// Shifts times so that the trajectory begins at 0 and the points' times count from there.
void count_from_first_pose(Source& source, bool is_recording, bool start_is_given) {
  if (!source.flight) return;
  FlightRecord& flight = *source.flight;
  const double begin_s = flight.reported.start_s();
  flight.reported = scan::delayed(flight.reported, -begin_s);
  if (is_recording) {
    flight.start = source.info.start.value_or(flight.start);
    return;
  }
  if (start_is_given || source.info.start)
    flight.start = later(start_is_given ? flight.start : *source.info.start, begin_s);
  source.info.start = flight.start;
  if (begin_s == 0 || !contains(source.info.fields, "time")) return;
  source.stream = [stream = source.stream, begin_s](const scan::PointSink& sink) {
    std::vector<scan::LabelledPoint> counted;
    return stream([&](std::span<const scan::LabelledPoint> points) {
      counted.assign(points.begin(), points.end());
      for (scan::LabelledPoint& point : counted) point.time -= begin_s;
      sink(counted);
    });
  };
}

// What the user says of the flight must not be what the recording says by itself.
void require_told_of_it(const fs::path& in, const Format& format,
                        const std::optional<FlightOptions>& flight) {
  if (!flight || !format.is_recording) return;
  if (format.has_topics)
    throw InputError(in,
                     "holds its own poses (/tf); --trajectory, --sensor, --spin, --mount and "
                     "--start are for clouds and pcap");
  if (flight->start_utc)
    throw InputError(in, "says by itself when it was recorded; --start is for clouds");
}

}  // namespace

FlightRecord scan_flight(const fs::path& folder, const SourceOptions& options) {
  if (options.flight)
    throw InputError(folder,
                     "is a scan folder, which says by itself what --trajectory, --sensor, "
                     "--spin, --mount and --start are for");
  if (!options.topic.empty())
    throw InputError(folder, "--topic is for bags and MCAP files; a scan folder has no topics");
  return read_flight_record(folder);
}

Source open_source(const fs::path& in, const SourceOptions& options) {
  if (fs::is_directory(in)) return open_scan_folder(in, options);
  require_file(in);
  const Format* format = find_format(in);
  // Without a known extension it is read as a cloud, which is recognised by its content.
  if (format == nullptr) format = find_format("cloud.pcd");
  if (!format->open) throw InputError(in, "a " + format->name + " is written, but not read");
  if (!options.topic.empty() && !format->has_topics)
    throw InputError(in, "--topic is for bags and MCAP files; a {} has no topics", format->name);
  require_told_of_it(in, *format, options.flight);
  Source source =
      format->open(in, {.flight = given_flight(options),
                        .sensor_given = options.flight && options.flight->sensor.has_value(),
                        .spin_given = options.flight && options.flight->spin_hz.has_value(),
                        .topic = options.topic});
  make_relative(source);
  count_from_first_pose(source, format->is_recording,
                        options.flight && options.flight->start_utc.has_value());
  if (format->is_recording) {
    end_with_trajectory(source);
    if (std::string note = motion_note(source, format->has_topics); !note.empty())
      source.notes.push_back(std::move(note));
  }
  return source;
}

}  // namespace plotscan::record
