// SPDX-License-Identifier: Apache-2.0
#include "estimate/diagnostics.h"

namespace plotscan::estimate {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GroundFacts, cell_m, nodes, unknown_share, seen_share, noise_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Agreed, height, plots, factor, factor_sd, residual_m)

namespace {

using nlohmann::json;

struct Reason {
  Unused unused;
  const char* key;    // in the manifest
  const char* words;  // for people
};

constexpr std::array<Reason, 8> kReasons = {
    {{Unused::not_finite, "not_finite", "without a place"},
     {Unused::marked, "marked", "withheld or noise"},
     {Unused::left_out, "left_out", "of classes left out"},
     {Unused::outside, "outside", "outside the field"},
     {Unused::repeated, "repeated", "repeated"},
     {Unused::thinned, "thinned", "thinned"},
     {Unused::outliers, "outliers", "neither ground nor crop"},
     {Unused::without_ground, "without_ground", "where the ground is unknown"}}};

void add(const PointAccount& points, json& document) {
  document["points_read"] = points.read;
  document["points_in_area"] = points.in_area;
  document["area_m"] = points.area_m;
  for (const Reason& reason : kReasons) {
    const auto count = points.unused.find(reason.unused);
    if (count != points.unused.end()) document[reason.key] = count->second;
  }
}

json boxes_json(const GivenBoxes& boxes) {
  return {{"plots", boxes.plots}, {"id", boxes.id_property}, {"from_degrees", boxes.from_degrees}};
}

json names_json(const GivenNames& names) {
  return {{"plots", names.plots}, {"id", names.id_property}, {"not_found", names.not_found}};
}

json measured_json(const GivenMeasured& measured) {
  json heights = json::array();
  for (const Agreed& agreed : measured.heights) {
    heights.push_back(agreed);
    if (agreed.trial > 0) heights.back()["trial_number"] = agreed.trial;
  }
  return {{"id", measured.id_column}, {"not_found", measured.not_found}, {"heights", heights}};
}

}  // namespace

std::string text_of(const PointAccount& points) {
  const auto without_ground = points.unused.find(Unused::without_ground);
  const std::uint64_t used =
      points.in_area - (without_ground == points.unused.end() ? 0 : without_ground->second);
  std::string text = std::to_string(points.read) + " read = " + std::to_string(used) + " used";
  for (const Reason& reason : kReasons) {
    const auto count = points.unused.find(reason.unused);
    if (count != points.unused.end() && count->second > 0)
      text += " + " + std::to_string(count->second) + " " + reason.words;
  }
  return text;
}

json to_json(const Diagnostics& diagnostics) {
  json document = diagnostics.of_method;
  if (diagnostics.notes) document["notes"] = *diagnostics.notes;
  if (diagnostics.points) add(*diagnostics.points, document);
  if (diagnostics.density_per_m2) document["density_per_m2"] = *diagnostics.density_per_m2;
  if (diagnostics.ground) document["ground"] = *diagnostics.ground;
  if (diagnostics.crops.size() == 1) document["crops"] = diagnostics.crops.front();
  if (diagnostics.crops.size() > 1) document["crops_of_trials"] = diagnostics.crops;
  if (!diagnostics.why_no_plots.empty()) document[kWhyNoPlots] = diagnostics.why_no_plots;
  if (diagnostics.boxes) document["boxes"] = boxes_json(*diagnostics.boxes);
  if (diagnostics.names) document["names"] = names_json(*diagnostics.names);
  if (diagnostics.measured) document["measured"] = measured_json(*diagnostics.measured);
  return document;
}

}  // namespace plotscan::estimate
