// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/recording/flight_record.h"
#include "scan/point.h"
#include "scan/point_reader.h"

namespace plotscan::record {

// Points to be converted, and what is known of their flight.
struct Source {
  std::filesystem::path path;  // for messages
  scan::CloudInfo info;
  std::optional<FlightRecord> flight;  // relative to info.origin_m, as the points are
  // Of the body, in the world frame and the points' time, where the file itself tells of it.
  std::optional<scan::Trajectory> trajectory = {};
  // Streams the points in the order of firing; may be called once.
  std::function<void(const scan::PointSink&)> stream = {};
};

// How a file is read.
struct ReadOptions {
  // What the user tells of the flight; a recording that is not self-contained throws InputError
  // without it.
  std::optional<FlightRecord> flight = {};
  bool sensor_told = true;  // whether flight.sensor is the user's word, not a default
  std::string topic = {};   // of the clouds in a bag or MCAP file; empty: as RosPoints chooses
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
  // The ways of writing it, the first by default; empty where there is but one.
  std::vector<std::string> encodings = {};
  bool has_crs = false;       // whether options.crs means something
  bool is_recording = false;  // of a flight, by a sensor or a robot; others are clouds
  bool has_topics = false;    // whether ReadOptions::topic means something
  // Whether only a flight's record turns points into this format; where it is set, source.flight is
  // there when `create` is called.
  bool needs_flight = false;
  bool needs_packets = false;  // whether the flight's sensor must send Velodyne's packets
  // Opens a file: reads its header, not its points. Empty when the format is only written.
  std::function<Source(const std::filesystem::path& file, const ReadOptions& options)> open = {};
  // A writer to the file. `source` outlives it. Empty when the format is only read.
  std::function<std::unique_ptr<scan::PointWriter>(
      const std::filesystem::path& file, const Source& source, const WriteOptions& options)>
      create = {};
};

}  // namespace plotscan::record
