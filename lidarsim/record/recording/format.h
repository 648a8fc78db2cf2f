// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/recording/flight_record.h"
#include "scan/cloud_reader.h"
#include "scan/point.h"
#include "scan/point_reader.h"

namespace plotscan::record {

// Where points to be converted come from, and what is known of their flight.
struct Source {
  std::filesystem::path path;  // for messages
  scan::CloudInfo info;
  std::optional<FlightRecord> flight;  // positions count from info.origin_m, like the points
  bool of_scan_folder = false;         // whether it is a scan of ours, in the world frame
  // The body's trajectory in the world frame and the points' time, if the file itself holds one.
  std::optional<scan::Trajectory> trajectory = {};
  // Streams the points in the order of firing; may be called once. Returns how many were passed on,
  // and how many have no place in the world: they are not finite, or no pose or transform covers
  // their time.
  std::function<scan::CloudSummary(const scan::PointSink&)> stream = {};
  std::vector<std::string> notes = {};  // what the user should know of it
};

// How a file is read.
struct ReadOptions {
  // What the user says about the flight. `open` throws InputError without it on a recording that is
  // not self-contained.
  std::optional<FlightRecord> flight = {};
  bool sensor_given = true;  // whether the user chose flight.sensor; false: a default
  bool spin_given = true;    // the same of flight.spin_hz
  std::string topic = {};    // of clouds in a bag or MCAP file; empty: RosPoints chooses
};

// How a file is written.
struct WriteOptions {
  std::string encoding = {};  // one of the format's encodings; empty: its first
  std::string crs = {};       // LAS: "local", the world frame, or "utm"; empty: local
  bool labels = true;         // PCD, PLY, LAS: write class, plot and plant
};

// A kind of file that points are read from, written to, or both, found by its extension.
struct Format {
  std::string name;                     // "binary PCD", for messages
  std::vector<std::string> extensions;  // with their dot, in lower case
  // The ways of writing it, the default first; empty if there is only one.
  std::vector<std::string> encodings = {};
  bool has_crs = false;       // whether WriteOptions::crs applies
  bool is_recording = false;  // of a flight, by a sensor or a robot; others are clouds
  bool has_topics = false;    // whether ReadOptions::topic applies
  // Whether writing this format needs a FlightRecord: then source.flight is set when `create` is
  // called.
  bool needs_flight = false;
  bool needs_packets = false;  // whether the flight's sensor must send Velodyne's packets
  // Opens a file: reads its header, not its points. Empty if the format can only be written.
  std::function<Source(const std::filesystem::path& file, const ReadOptions& options)> open = {};
  // Makes a writer to the file. `source` must outlive it. Empty if the format can only be read.
  std::function<std::unique_ptr<scan::PointWriter>(
      const std::filesystem::path& file, const Source& source, const WriteOptions& options)>
      create = {};
};

}  // namespace plotscan::record
