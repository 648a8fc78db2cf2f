// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "strata/measured_field.h"
#include "strata/stratum_tally.h"

namespace plotscan::strata {

// All fields of a measurement: farms by stratum, fields without plots by kind.
struct Measurement {
  std::vector<MeasuredField> farms;
  std::vector<MeasuredField> empty_fields;
};

// The table for people: a line a stratum, a line a kind of field without plots, the confidence.
std::vector<std::string> table_lines(const Measurement& measurement);

// "ordinary 3: 27 plots, 27 found, 0 extra, IoU 0.958, mean +1.2 p95 -0.3 max +0.4 cm".
std::string field_line(const MeasuredField& field);

// The same for machines, farm by farm too; lengths in metres, null for what cannot be computed.
nlohmann::json to_json(const Measurement& measurement);

}  // namespace plotscan::strata
