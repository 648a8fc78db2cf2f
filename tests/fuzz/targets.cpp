// SPDX-License-Identifier: Apache-2.0
#include "fuzz/targets.h"

#include <fstream>

#include "core/error.h"
#include "core/manifest.h"
#include "description/load_description.h"
#include "estimate/estimate.h"
#include "estimate/internal/esri_grid.h"
#include "estimate/measured_heights.h"
#include "estimate/plot_map.h"
#include "farmbench/entry/internal/entered_rows.h"
#include "farmbench/entry/problems.h"
#include "farmbench/suite.h"
#include "flight/waypoint_file.h"
#include "gazebo/read_world.h"
#include "mesh/mesh_import.h"
#include "record/open_source.h"
#include "record/positions.h"
#include "scan/point_reader.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"

namespace plotscan::fuzz {
namespace {

namespace fs = std::filesystem;

// Both ways that clouds and recordings come in: with all their fields, and as positions.
void read_cloud(const fs::path& file) {
  record::read_cloud_system(file);
  record::read_positions(file, [](auto) {});
  const record::Source source = record::open_source(file, {});
  source.stream([](auto) {});
}

// A suite's farms are read with it.
void read_suite(const fs::path& file) {
  std::ofstream(file.parent_path() / "field.yaml")
      << "terrain: {side_m: 10}\n"
         "plots: {width_m: 1, length_m: 1, gap_width_m: 1, gap_length_m: 1, rows: [{plots: 2}]}\n"
         "plants: {count: 2, models: [{crop: maize, stage: V3}]}\n";
  farmbench::load_suite(file);
}

// A pcap does not know where its sensor was. (Not read without libpcap.)
[[maybe_unused]] void read_pcap(const fs::path& file) {
  const fs::path flight = file.parent_path() / "flight.tum";
  std::ofstream(flight) << "0 0 0 5 0 0 0 1\n10 5 0 5 0 0 0 1\n";
  record::FlightOptions options;
  options.trajectory = flight;
  const record::Source source = record::open_source(file, {.flight = options, .topic = {}});
  source.stream([](auto) {});
}

void read_manifest_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  read_manifest(folder);
  unlisted_files(folder);
  require_unchanged(folder, "truth");
}

void read_plots(const fs::path& file) {
  estimate::read_plot_map(file, "EPSG:32616", 1);
  estimate::read_estimate(file);
}

void read_submitted(const fs::path& file) {
  farmbench::Problems problems;
  if (file.extension() == ".csv") {
    farmbench::read_entered_table(file, problems);
  } else {
    farmbench::read_entered_features(file, problems);
  }
  problems.raise(file.parent_path());
}

void read_mesh(const fs::path& file) { mesh::import_mesh(file); }

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"farm", ".yaml", Structure::yaml,
       [](const fs::path& f) { description::load_description(f); }},
      {"sensor", ".yaml", Structure::yaml, [](const fs::path& f) { sensor::load_sensor(f); }},
      {"suite", ".yaml", Structure::yaml, read_suite},
      {"waypoints", ".yaml", Structure::yaml, [](const fs::path& f) { flight::read_waypoints(f); }},
      {"pcd", ".pcd", Structure::bytes, read_cloud},
      {"ply", ".ply", Structure::bytes, read_cloud},
      {"las", ".las", Structure::bytes, read_cloud},
      {"text", ".xyz", Structure::bytes, read_cloud},
#ifdef PLOTSCAN_HAVE_PCAP
      {"pcap", ".pcap", Structure::bytes, read_pcap},
#endif
      {"bag", ".bag", Structure::bytes, read_cloud},
      {"mcap", ".mcap", Structure::bytes, read_cloud},
      {"trajectory", ".csv", Structure::bytes, [](const fs::path& f) { scan::read_trajectory(f); }},
#ifdef PLOTSCAN_HAVE_SDFORMAT
      {"world", ".sdf", Structure::xml, [](const fs::path& f) { gazebo::read_world(f); }},
#endif
      {"collada", ".dae", Structure::xml, read_mesh},
      {"gltf", ".gltf", Structure::json, read_mesh},
      {"obj", ".obj", Structure::bytes, read_mesh},
      {"plots", ".geojson", Structure::json, read_plots},
      {"places", ".csv", Structure::bytes,
       [](const fs::path& f) { estimate::read_named_places(f); }},
      {"measured", ".csv", Structure::bytes,
       [](const fs::path& f) { estimate::read_measured_heights(f); }},
      {"grid", ".asc", Structure::bytes, [](const fs::path& f) { estimate::read_esri_grid(f); }},
      {"manifest", ".json", Structure::json, read_manifest_of},
      {"submitted-boxes", ".geojson", Structure::json, read_submitted},
      {"submitted-table", ".csv", Structure::bytes, read_submitted},
  };
  return all;
}

bool is_read(const Target& target, const std::string& bytes, const fs::path& folder) {
  const fs::path file =
      folder / ((target.name == "manifest" ? "manifest" : "input") + target.extension);
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    target.read(file);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace plotscan::fuzz
