// SPDX-License-Identifier: Apache-2.0
#include "farmbench/blind_files.h"

#include <algorithm>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/output_file.h"
#include "core/place_json.h"
#include "core/plot_features.h"
#include "core/text_file.h"
#include "core/utc_time.h"
#include "record/convert.h"
#include "record/scan_folder.h"
#include "record/scan_formats.h"
#include "sensor/sensor.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// What an operator knows of the flight: when, with which sensor, how it was mounted.
json flight_json(const fs::path& scan, const lidar::FlyOptions& flight) {
  const record::FlightRecord record = record::read_flight_record(scan);
  json document = {{"sensor", record.sensor.title},
                   {"sensor_file", "sensor.yaml"},
                   {"spin_hz", record.spin_hz},
                   {"mount_rpy_deg",
                    {flight.mount_rpy_deg.x(), flight.mount_rpy_deg.y(), flight.mount_rpy_deg.z()}},
                   {"returns", flight.returns},
                   {"start_utc", format_utc(record.start)}};
  if (record.anchor) document["world_origin_wgs84"] = anchor_json(*record.anchor);
  return document;
}

}  // namespace

std::uint64_t write_blind_cloud(const fs::path& source, const fs::path& cloud,
                                const std::optional<cloud::Area>& survey) {
  record::Source points = record::open_source(source, {});
  if (survey) {
    points.stream = [&survey, all = points.stream,
                     origin_m = points.info.origin_m](const scan::PointSink& sink) {
      return all(only_inside(*survey, origin_m, sink));
    };
  }
  return record::write_points(points, cloud, {.labels = false}).points;
}

void write_boxes(const fs::path& folder, const std::vector<score::TruePlot>& plots) {
  std::vector<PlotFeature> features;
  TextFile table(folder / "boxes.csv");
  table << "plot_number,center_x_m,center_y_m,width_m,length_m,heading_deg\n";
  for (const score::TruePlot& plot : plots) {
    if (!plot.scored) continue;
    features.push_back({.box = plot.box, .properties = {{"plot_number", plot.id}}, .id = plot.id});
    table << csv_field(plot.id.text()) << "," << plot.box.center.x() << "," << plot.box.center.y()
          << "," << plot.box.width_m << "," << plot.box.length_m << ","
          << plot.box.heading_rad / kDegrees << "\n";
  }
  table.close();
  write_plot_features(folder / "boxes.geojson", features);
}

void require_parts(const BlindParts& parts, const Suite& suite) {
  for (const std::string& format : parts.formats) {
    if (format != "pcd" && format != "las" && format != "pcap")
      throw InputError("there is no format \"" + format + "\"; there are pcd, las, pcap");
    if (std::ranges::count(parts.formats, format) > 1)
      throw InputError("the format \"" + format + "\" is named twice");
  }
  if (std::ranges::all_of(parts.formats, [](const auto& format) { return format == "pcap"; }))
    throw InputError("an export has clouds: name pcd or las, beside pcap or not");
  for (const SuiteCase& suite_case : suite.cases)
    record::require_formats(parts.formats, sensor::load_sensor(suite_case.flight.sensor));
}

std::uint64_t write_blind_files(const FarmPlace& place, const BlindParts& parts,
                                const fs::path& folder) {
  std::uint64_t points = 0;
  const fs::path scan = place.folder / "scan";
  for (const std::string& format : parts.formats) {
    if (format == "pcap") {
      record::convert(scan, folder / "flight.pcap", {});
    } else {
      points = write_blind_cloud(scan, folder / ("cloud." + format), place.suite_case.survey);
    }
  }
  if (parts.boxes) {
    std::vector<score::TruePlot> plots = standing_plots(place);
    if (place.suite_case.without_plots) plots.clear();
    write_boxes(folder, plots);
  }
  fs::copy_file(scan / "poses.csv", folder / "poses.csv");
  fs::copy_file(scan / "sensor.yaml", folder / "sensor.yaml");
  write_whole_file(folder / "flight.json", json_lines(flight_json(scan, place.suite_case.flight)));
  return points;
}

}  // namespace plotscan::farmbench
