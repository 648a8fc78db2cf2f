// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// A sensor's main figures, as in a data sheet.
struct SensorSummary {
  std::string name;
  std::string title;
  int channels = 0;
  double shots_per_s = 0;  // at the default spin
  double min_range_m = 0;
  double max_range_m = 0;
  // Only of a spinning sensor, which sees all around: its lowest and highest laser, and its spin.
  double least_elevation_deg = 0;
  double most_elevation_deg = 0;
  double min_spin_hz = 0;
  double max_spin_hz = 0;
  double default_spin_hz = 0;
  bool is_risley = false;
  double cone_deg = 0;  // of a Risley scanner: the full angle of its field of view; else 0
};

SensorSummary summary_of(const Sensor& sensor);

// A table as text: a line of headings, then one line per sensor.
std::vector<std::string> summary_lines(const std::vector<SensorSummary>& summaries);

nlohmann::json summary_json(const SensorSummary& summary);

}  // namespace plotscan::sensor
