// SPDX-License-Identifier: Apache-2.0
#include "plotscan/clouds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/core.h>

#include "boundary/guarded.h"
#include "core/output_file.h"
#include "record/convert.h"
#include "record/formats.h"
#include "record/open_source.h"

namespace plotscan {
namespace {

constexpr std::size_t kPiece = 1 << 16;  // points that are converted at a time

Point outer(const scan::LabelledPoint& point) {
  return {.x = point.x,
          .y = point.y,
          .z = point.z,
          .intensity = point.intensity,
          .ring = point.ring,
          .time = point.time,
          .return_number = point.return_number,
          .return_count = point.return_count,
          .label = static_cast<std::uint8_t>(point.label),
          .plot = point.plot,
          .plant = point.plant};
}

scan::LabelledPoint inner(const Point& point) {
  return {.x = point.x,
          .y = point.y,
          .z = point.z,
          .intensity = point.intensity,
          .ring = point.ring,
          .time = point.time,
          .return_number = point.return_number,
          .return_count = point.return_count,
          .label = static_cast<scan::PointClass>(point.label),
          .plot = point.plot,
          .plant = point.plant};
}

// The points as what record writes; they must outlive the source.
record::Source source_of(std::span<const Point> points, const WriteCloudOptions& options) {
  record::Source source{.path = "the cloud", .info = {.points = points.size()}, .flight = {}};
  source.info.origin_m = Eigen::Vector3d(options.origin_m.data());
  source.info.crs_wkt = options.crs_wkt;
  source.stream = [points](const scan::PointSink& sink) {
    std::vector<scan::LabelledPoint> piece;
    for (std::size_t first = 0; first < points.size(); first += kPiece) {
      const auto part = points.subspan(first, std::min(kPiece, points.size() - first));
      piece.clear();
      std::ranges::transform(part, std::back_inserter(piece), inner);
      sink(piece);
    }
    return scan::CloudSummary{.points = points.size()};
  };
  return source;
}

// What readers refuse is not written.
void require_readable(std::span<const Point> points, const WriteCloudOptions& options) {
  if (!Eigen::Vector3d(options.origin_m.data()).allFinite())
    throw InputError("origin_m must be three finite numbers");
  const auto unreadable = std::ranges::find_if(points, [](const Point& point) {
    return !std::isfinite(point.time) || !std::isfinite(point.intensity);
  });
  if (unreadable == points.end()) return;
  throw InputError(fmt::format(
      "point {} of {} has the time {:g} and the intensity {:g}; both must "
      "be finite numbers",
      unreadable - points.begin() + 1, points.size(), unreadable->time, unreadable->intensity));
}

}  // namespace

PointsView Cloud::positions() const {
  return {points.empty() ? nullptr : &points.front().x, points.size(), sizeof(Point), origin_m};
}

Cloud read_cloud(const std::filesystem::path& file, const Progress& progress) {
  return boundary::guarded([&] {
    const record::Source source = record::open_source(file, {});
    const scan::CloudInfo& info = source.info;
    Cloud cloud{.origin_m = {info.origin_m.x(), info.origin_m.y(), info.origin_m.z()},
                .points = {},
                .fields = info.fields,
                .crs_wkt = info.crs_wkt};
    // A broken file may promise any number.
    constexpr std::uint64_t kMostReserved = 1 << 24;
    cloud.points.reserve(std::min(info.points, kMostReserved));
    source.stream([&](std::span<const scan::LabelledPoint> points) {
      std::ranges::transform(points, std::back_inserter(cloud.points), outer);
      if (progress && info.points > 0)
        progress(std::min(
            1.0, static_cast<double>(cloud.points.size()) / static_cast<double>(info.points)));
    });
    return cloud;
  });
}

void write_cloud(const std::filesystem::path& file, std::span<const Point> points,
                 const WriteCloudOptions& options, const Progress& progress) {
  boundary::guarded([&] {
    require_readable(points, options);
    OutputFile out(file, options.replace);
    const record::Source source = source_of(points, options);
    const record::WriteOptions write{.encoding = options.encoding};
    record::require_writable(source, file, write);
    record::write_points(source, out.path(), write, progress);
    out.commit();
  });
}

std::uint64_t convert_cloud(const std::filesystem::path& in, const std::filesystem::path& out,
                            const ConvertCloudOptions& options, const Progress& progress) {
  return boundary::guarded([&] {
    const record::ConvertSummary summary =
        record::convert(in, out,
                        {.topic = options.topic,
                         .write = {.encoding = options.encoding, .crs = options.crs},
                         .replace = options.replace},
                        progress);
    return std::max(summary.points, summary.poses);
  });
}

}  // namespace plotscan
