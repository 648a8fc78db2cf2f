// SPDX-License-Identifier: Apache-2.0
#include "record/positions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "record/open_source.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

bool is_recording(const fs::path& file) {
  const Format* format = find_format(file);
  return format != nullptr && format->is_recording;
}

// Whether the files are recordings. Throws InputError if recordings and clouds are mixed.
bool are_recordings(const CloudFiles& cloud) {
  const auto other = std::ranges::find_if_not(cloud.files, is_recording);
  if (other == cloud.files.end()) return true;
  if (std::ranges::any_of(cloud.files, is_recording)) {
    throw InputError(*other,
                     "is a cloud, and others are recordings: convert these to clouds first "
                     "(lidarsim convert)");
  }
  if (cloud.recording.any()) {
    throw InputError(*other,
                     "is a cloud; --trajectory, --sensor, --mount and --topic tell of a recording "
                     "(.pcap, .bag, .mcap)");
  }
  return false;
}

// Opens a recording so that its points are placed in the world.
Source open_recording(const fs::path& file, const RecordingOptions& given) {
  if (!find_format(file)->has_topics && !given.trajectory) {
    throw InputError(file,
                     "does not say where the sensor was; give --trajectory FILE (TUM text or "
                     "trajectory.csv), and --mount where it is not that of lidarsim fly");
  }
  std::optional<FlightOptions> flight;
  if (given.trajectory || given.sensor || given.mount_rpy_deg) {
    flight = {.trajectory = given.trajectory, .sensor = given.sensor};
    if (given.mount_rpy_deg) flight->mount_rpy_deg = *given.mount_rpy_deg;
  }
  return open_source(file, {.flight = flight, .topic = given.topic});
}

std::vector<Source> open_recordings(const CloudFiles& cloud) {
  return list_of(cloud.files,
                 [&](const fs::path& file) { return open_recording(file, cloud.recording); });
}

// The body's first position, if it is known.
std::optional<Eigen::Vector3d> first_place(const Source& source) {
  if (source.flight)
    return source.info.origin_m + source.flight->reported.poses().front().position_m;
  if (source.trajectory) return source.trajectory->poses().front().position_m;
  return std::nullopt;
}

// The one coordinate system of all sources; the user's word is checked against each of them.
scan::CloudSystem system_of(const CloudFiles& cloud, const std::vector<Source>& sources) {
  scan::CloudSystem system;
  std::vector<std::string> notes;
  for (const Source& source : sources) {
    system = scan::users_system(cloud, source.path, first_place(source));
    notes.insert(notes.end(), source.notes.begin(), source.notes.end());
  }
  system.notes.insert(system.notes.end(), notes.begin(), notes.end());
  system.start = sources.front().info.start;
  return system;
}

void require_no_classes(const CloudFiles& cloud) {
  if (cloud.leave_out_classes.empty() && cloud.only_classes.empty()) return;
  throw InputError(cloud.files.front(), "is a recording: its points have no classes");
}

// Streams the source's positions in metres to `sink`. `take` first gets each point and its position
// in the file's units. Returns the number of points that could not be placed.
using Take = std::function<void(const scan::LabelledPoint&, const Eigen::Vector3d& position)>;
std::uint64_t stream(const Source& source, const scan::CloudSystem& system,
                     const scan::PositionSink& sink, const Take& take) {
  std::vector<Eigen::Vector3d> positions;
  return source
      .stream([&](std::span<const scan::LabelledPoint> points) {
        positions.clear();
        for (const scan::LabelledPoint& point : points) {
          const Eigen::Vector3d position =
              source.info.origin_m + Eigen::Vector3d(point.x, point.y, point.z);
          positions.push_back(system.metres_of(position));
          take(point, position);
        }
        sink(positions);
      })
      .not_finite;
}

void take_time(const Source& source, double time_s, scan::CloudFacts& facts) {
  scan::extend(facts.time_s, time_s);
  constexpr double kCentury_s = 3.2e9;  // a time beyond is none
  if (source.info.start && std::abs(time_s) <= kCentury_s)
    scan::extend(facts.utc, later(*source.info.start, time_s));
}

void add_facts(const Source& source, const scan::PositionSink& sink, scan::CloudFacts& facts) {
  const bool has_returns = contains(source.info.fields, "return_number");
  const bool has_time = contains(source.info.fields, "time");
  if (has_returns && !facts.returns) facts.returns.emplace();
  facts.not_finite +=
      stream(source, facts.system, sink, [&](const auto& point, const auto& position) {
        ++facts.points;
        facts.bounds.extend(position);
        facts.bounds_m.extend(facts.system.metres_of(position));
        if (has_returns) ++(*facts.returns)[point.return_number];
        if (has_time) take_time(source, point.time, facts);
      });
}

}  // namespace

scan::CloudSummary read_positions(const CloudFiles& cloud, const scan::PositionSink& sink,
                                  const scan::PositionOptions& options) {
  if (!are_recordings(cloud)) return scan::read_positions(cloud, sink, options);
  require_no_classes(cloud);
  const std::vector<Source> sources = open_recordings(cloud);
  scan::CloudSummary summary{.system = system_of(cloud, sources)};
  for (const Source& source : sources) {
    summary.not_finite +=
        stream(source, summary.system, sink, [&](const auto&, const auto&) { ++summary.points; });
  }
  if (summary.points == 0) throw InputError(cloud.name() + ": holds no point");
  return summary;
}

double expected_points(const CloudFiles& cloud) {
  constexpr double kBytesInPacket = 3.3;  // bytes a point: frames of 1,272 bytes for 384 returns
  constexpr double kBytesInMessage = 26;  // bytes a point as `lidarsim convert` writes it
  if (!are_recordings(cloud)) return scan::expected_points(cloud);
  double points = 0;
  for (const fs::path& file : cloud.files) {
    const double bytes = find_format(file)->has_topics ? kBytesInMessage : kBytesInPacket;
    points += static_cast<double>(fs::file_size(file)) / bytes;
  }
  return points;
}

scan::CloudSystem read_cloud_system(const CloudFiles& cloud) {
  if (!are_recordings(cloud)) return scan::read_cloud_system(cloud);
  return system_of(cloud, open_recordings(cloud));
}

scan::CloudFacts read_cloud_facts(const CloudFiles& cloud, const scan::PositionSink& sink) {
  if (!are_recordings(cloud)) return scan::read_cloud_facts(cloud, sink);
  const std::vector<Source> sources = open_recordings(cloud);
  scan::CloudFacts facts{.format = find_format(cloud.files.front())->name,
                         .system = system_of(cloud, sources),
                         .fields = sources.front().info.fields};
  for (const Source& source : sources) add_facts(source, sink, facts);
  if (facts.points == 0) throw InputError(cloud.name() + ": holds no point");
  return facts;
}

}  // namespace plotscan::record
