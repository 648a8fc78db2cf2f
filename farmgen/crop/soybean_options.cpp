// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cmath>

#include "crop/soybean.h"

#include "core/csv.h"
#include "core/error.h"
#include "core/range.h"
#include "core/text.h"

namespace plotscan::crop {
namespace {

struct Parameter {
  const char* name;
  double SoybeanOptions::*value;
  Range range;
  bool whole;
};

constexpr std::array<Parameter, 17> kParameters = {{
    {"nodes", &SoybeanOptions::nodes, {3, 30}, true},
    {"first_leaf_node", &SoybeanOptions::first_leaf_node, {1, 30}, true},
    {"internode_m", &SoybeanOptions::internode_m, {0.005, 0.2}, false},
    {"lean_deg", &SoybeanOptions::lean_deg, {0, 30}, false},
    {"zigzag_deg", &SoybeanOptions::zigzag_deg, {0, 30}, false},
    {"stem_radius_m", &SoybeanOptions::stem_radius_m, {0.0005, 0.02}, false},
    {"branches", &SoybeanOptions::branches, {0, 10}, true},
    {"branch_nodes", &SoybeanOptions::branch_nodes, {1, 15}, true},
    {"branch_angle_deg", &SoybeanOptions::branch_angle_deg, {0, 80}, false},
    {"phyllotaxis_deg", &SoybeanOptions::phyllotaxis_deg, {0, 360}, false},
    {"petiole_m", &SoybeanOptions::petiole_m, {0.01, 0.5}, false},
    {"petiole_angle_deg", &SoybeanOptions::petiole_angle_deg, {0, 90}, false},
    {"leaflet_length_m", &SoybeanOptions::leaflet_length_m, {0.01, 0.3}, false},
    {"leaflet_width_ratio", &SoybeanOptions::leaflet_width_ratio, {0.1, 1.5}, false},
    {"leaflet_bend_deg", &SoybeanOptions::leaflet_bend_deg, {0, 150}, false},
    {"leaflet_fold_deg", &SoybeanOptions::leaflet_fold_deg, {0, 60}, false},
    {"variation", &SoybeanOptions::variation, {0, 0.5}, false},
}};

std::string range_text(const Parameter& parameter) {
  return (parameter.whole ? "a whole number in " : "a number in ") + parameter.range.text();
}

const Parameter& parameter_named(const std::string& name, const std::string& assignment) {
  std::string known;
  for (const Parameter& parameter : kParameters) {
    if (name == parameter.name) return parameter;
    known += std::string(known.empty() ? "" : ", ") + parameter.name;
  }
  throw InputError("--set " + assignment + ": " + name + " is not a known key; known are " + known);
}

}  // namespace

SoybeanOptions soybean_options(const std::vector<std::string>& assignments) {
  SoybeanOptions options;
  for (const std::string& assignment : assignments) {
    const auto equals = std::min(assignment.find('='), assignment.size());
    const Parameter& parameter = parameter_named(assignment.substr(0, equals), assignment);
    const char* const end = assignment.data() + assignment.size();
    const char* const begin = std::min(assignment.data() + equals + 1, end);
    double value = 0;
    const auto parsed = std::from_chars(begin, end, value);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end;
    if (!number || !parameter.range.contains(value) ||
        (parameter.whole && value != std::floor(value))) {
      throw InputError("--set " + assignment + ": " + parameter.name + " is to be " +
                       range_text(parameter));
    }
    options.*parameter.value = value;
  }
  return options;
}

std::string soybean_options_help() {
  std::string text;
  for (const Parameter& parameter : kParameters) {
    text += formatted("  %-20s %-7s %s\n", parameter.name,
                      format_number(SoybeanOptions{}.*parameter.value).c_str(),
                      range_text(parameter).c_str());
  }
  return text;
}

}  // namespace plotscan::crop
