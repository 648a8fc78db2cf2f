// SPDX-License-Identifier: Apache-2.0
#include "record/convert.h"

#include <algorithm>

#include "core/contains.h"
#include "core/coordinate_units.h"
#include "core/error.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/text.h"
#include "scan/las_crs.h"
#include "scan/trajectory.h"

namespace plotscan::record {
namespace fs = std::filesystem;
namespace {

bool is_trajectory(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".tum" || extension == ".txt" || extension == ".csv";
}

// Of clouds and recordings.
std::vector<std::string> point_extensions() {
  return extensions_of([](const Format& format) { return format.create != nullptr; });
}

std::string writable_extensions() {
  std::vector<std::string> extensions = point_extensions();
  extensions.insert(extensions.end(), {".tum", ".txt", ".csv"});
  return joined(extensions, ", ");
}

std::string where_points_go(const fs::path& out) {
  return lower_extension(out) + " is a trajectory's here; points are written into a file whose " +
         "name ends in one of " + joined(point_extensions(), ", ");
}

SourceOptions source_options(const ConvertOptions& options) {
  return {.flight = options.flight, .topic = options.topic};
}

Source open(const fs::path& in, const ConvertOptions& options) {
  return open_source(in, source_options(options));
}

ConvertSummary write_poses(const scan::Trajectory& trajectory, const fs::path& out) {
  if (lower_extension(out) == ".csv") {
    scan::write_trajectory(out, trajectory);
  } else {
    scan::write_tum(out, trajectory);
  }
  return {.poses = trajectory.poses().size()};
}

// Reads a trajectory file, or the reported trajectory of a scan folder or a recording.
scan::Trajectory trajectory_of(const fs::path& in, const fs::path& out,
                               const ConvertOptions& options) {
  if (!options.write.encoding.empty() || !options.write.crs.empty())
    throw InputError("--encoding and --crs are for clouds, and a trajectory is written");
  if (fs::is_directory(in)) return scan_flight(in, source_options(options)).reported;
  if (is_trajectory(in)) {
    if (options.flight || !options.topic.empty())
      throw InputError(in,
                       "is a trajectory; --trajectory, --sensor, --spin, --mount, --start and "
                       "--topic are for clouds and recordings");
    return scan::read_trajectory(in);
  }
  const Source source = open(in, options);
  if (source.flight) return scan::moved(source.flight->reported, source.info.origin_m);
  if (source.trajectory) return *source.trajectory;
  throw InputError(in, "holds points but no trajectory; " + where_points_go(out));
}

const Format& writable_format(const fs::path& out) {
  const Format* format = find_format(out);
  if (format != nullptr && format->create) return *format;
  if (is_trajectory(out)) throw InputError(out, "cannot be written: " + where_points_go(out));
  const std::string laz = lower_extension(out) == ".laz"
                              ? "; .laz where built with LASzip (liblaszip-dev on Debian 13 and "
                                "Ubuntu 24.04)"
                              : "";
  throw InputError(out, "cannot be written: its name must end in one of {}{}",
                   writable_extensions(), laz);
}

void require_options(const Format& format, const fs::path& out, const WriteOptions& options) {
  const auto& encodings = format.encodings;
  if (!options.encoding.empty() && !contains(encodings, options.encoding)) {
    throw InputError(
        out, "--encoding {} is none of a {}{}", options.encoding, format.name,
        encodings.empty() ? ", which has but one" : "; there are " + joined(encodings, ", "));
  }
  if (!options.crs.empty() && !format.has_crs)
    throw InputError(out, "--crs is for LAS; a " + format.name + " has no coordinate system");
  if (!options.crs.empty() && options.crs != "local" && options.crs != "utm")
    throw InputError(out, "--crs \"" + options.crs + "\" must be local or utm");
}

// What a file of the format cannot state.
std::optional<std::string> units_note(const Source& source, const Format& format) {
  const auto unit_m = scan::units_of_wkt(source.info.crs_wkt).horizontal_m;
  if (format.has_crs || !unit_m || *unit_m == 1) return std::nullopt;
  return "its coordinates stay in " + unit_name(*unit_m) + ", which a " + format.name +
         " does not state; say --units where it is read";
}

}  // namespace

void require_writable(const Source& source, const fs::path& out, const WriteOptions& options) {
  const Format& format = writable_format(out);
  require_options(format, out, options);
  if (format.needs_flight && !source.flight) {
    throw InputError(
        out, "a {} needs the flight; {} (and --sensor, --spin, --mount, --start)", format.name,
        source.trajectory ? "convert " + source.path.filename().string() +
                                " to a .tum and to a cloud first, then the cloud with --trajectory"
                          : "give a scan folder, or --trajectory FILE");
  }
}

ConvertSummary write_points(const Source& source, const fs::path& out, const WriteOptions& options,
                            const ProgressReport& progress) {
  ConvertSummary summary;
  const auto writer = writable_format(out).create(out, source, options);
  const auto write = [&](std::span<const scan::LabelledPoint> points) {
    writer->write(points);
    summary.points += points.size();
    if (progress && source.info.points > 0)
      progress(std::min(
          1.0, static_cast<double>(summary.points) / static_cast<double>(source.info.points)));
  };
  summary.without_place = source.stream(write).not_finite;
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
    summary = write_poses(trajectory_of(in, out, options), file.path());
  } else if (is_trajectory(in)) {
    throw InputError(in,
                     "is a trajectory by its extension, which is converted to .tum, .txt or .csv; "
                     "a cloud as text is called .xyz here");
  } else {
    const Source source = open(in, options);
    require_writable(source, out, options.write);
    summary = write_points(source, file.path(), options.write, progress);
    summary.notes = source.notes;
    if (const auto note = units_note(source, writable_format(out))) summary.notes.push_back(*note);
  }
  file.commit();
  return summary;
}

}  // namespace plotscan::record
