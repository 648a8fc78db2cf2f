// SPDX-License-Identifier: Apache-2.0
#include "inspect/cloud_report.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/core.h>

#include "cloud/coordinate_step.h"
#include "core/utc_time.h"
#include "record/positions.h"

namespace plotscan::inspect {
namespace {

using nlohmann::json;

constexpr double kShortestSide_m = 0.1;  // of the smallest plots
constexpr std::size_t kGroundClass = 2;
constexpr std::array<std::size_t, 2> kNoiseClasses = {7, 18};

// The field's outline reaches beyond the outermost points (find_field), which end what was scanned.
void clip_field(CloudReport& report) {
  const Eigen::AlignedBox3d& scanned_m = report.facts.bounds_m;
  cloud::Area& field = report.density.field;
  for (const int axis : {0, 1}) {
    double& least = field[static_cast<std::size_t>(axis)];
    double& most = field[static_cast<std::size_t>(axis) + 2];
    least = std::max(least, scanned_m.min()[axis]);
    most = std::min(most, scanned_m.max()[axis]);
  }
  report.density.area_m2 = std::min(report.density.area_m2, cloud::sides_of(field).prod());
}

void judge_density(CloudReport& report) {
  const double density = report.density.median;
  const auto too_few = [&](const char* how) {
    return fmt::format("{} points/m2 {} too few: plots are found from about {:.0f} on",
                       cloud::density_text(density), how, cloud::kPlotsFound_m2);
  };
  if (density <= cloud::kPlotsLost_m2) {
    report.obstacles.push_back(too_few("are"));
  } else if (density < cloud::kPlotsFound_m2) {
    report.doubts.push_back(too_few("may be"));
  }
}

void judge_extent(CloudReport& report) {
  if (report.facts.bounds_m.sizes().head<2>().maxCoeff() < kShortestSide_m)
    report.obstacles.emplace_back(
        "all points lie within 10 cm of one place; give "
        "--crs EPSG:4326 if x and y are longitude and latitude");
  if (cloud::sides_of(report.density.field).maxCoeff() > cloud::kLongestSide_m)
    report.obstacles.emplace_back(
        "the field is over 10 km long: give a part of it (--crop-box), or --units");
}

void judge_steps(const cloud::CoordinateSteps& steps, CloudReport& report) {
  const std::string note = cloud::step_note(steps.steps_m(), report.density.median);
  if (!note.empty()) report.doubts.push_back(note);
}

// A cloud whose crop was filtered out.
void judge_classes(CloudReport& report) {
  if (!report.facts.classes) return;
  const scan::CountByNumber& classes = *report.facts.classes;
  std::uint64_t noise = 0;
  for (const std::size_t number : kNoiseClasses) noise += classes[number];
  if (classes[kGroundClass] > 0 && classes[kGroundClass] + noise == report.facts.points)
    report.obstacles.emplace_back(
        "every point but noise is of the class ground: there is no crop, or it was taken out");
}

json counts_json(const std::optional<scan::CountByNumber>& counts) {
  if (!counts) return nullptr;
  json document = json::object();
  for (std::size_t i = 0; i < counts->size(); ++i)
    if ((*counts)[i] > 0) document[std::to_string(i)] = (*counts)[i];
  return document;
}

json bounds_json(const Eigen::AlignedBox3d& bounds) {
  return {{"least", {bounds.min().x(), bounds.min().y(), bounds.min().z()}},
          {"most", {bounds.max().x(), bounds.max().y(), bounds.max().z()}}};
}

json time_json(const scan::CloudFacts& facts) {
  if (!facts.time_s) return nullptr;
  json document = {{"first_s", (*facts.time_s)[0]}, {"last_s", (*facts.time_s)[1]}};
  if (facts.utc) {
    document["first_utc"] = format_utc((*facts.utc)[0]);
    document["last_utc"] = format_utc((*facts.utc)[1]);
  }
  return document;
}

}  // namespace

CloudReport inspect_cloud(const CloudFiles& cloud) {
  cloud::TileCounter tiles;
  cloud::CoordinateSteps steps;
  const auto take = [&](std::span<const Eigen::Vector3d> points) {
    tiles.add(points);
    steps.add(points);
  };
  CloudReport report{.facts = record::read_cloud_facts(cloud, take), .density = {}};
  const std::vector<cloud::TileCount> counts = tiles.counts();
  cloud::require_places(counts, cloud.name());
  report.density = cloud::field_density(counts);
  clip_field(report);
  judge_density(report);
  judge_extent(report);
  judge_steps(steps, report);
  judge_classes(report);
  return report;
}

std::string class_name(std::size_t number) {
  static constexpr std::array<const char*, 19> kNames = {"never classified",
                                                         "unclassified",
                                                         "ground",
                                                         "low vegetation",
                                                         "medium vegetation",
                                                         "high vegetation",
                                                         "building",
                                                         "low noise",
                                                         "",
                                                         "water",
                                                         "rail",
                                                         "road",
                                                         "",
                                                         "wire guard",
                                                         "wire conductor",
                                                         "transmission tower",
                                                         "wire connector",
                                                         "bridge deck",
                                                         "high noise"};
  return number < kNames.size() ? kNames[number] : "";
}

json to_json(const CloudReport& report) {
  const scan::CloudFacts& facts = report.facts;
  const cloud::FieldDensity& density = report.density;
  return {
      {"format", facts.format},
      {"points", facts.points},
      {"not_finite", facts.not_finite},
      {"marked", facts.marked},
      {"extent", bounds_json(facts.bounds)},
      {"extent_m", bounds_json(facts.bounds_m)},
      {"units_m", {{"x_y", facts.system.units.horizontal_m}, {"z", facts.system.units.vertical_m}}},
      {"crs", facts.system.crs},
      {"notes", facts.system.notes},
      {"fields", facts.fields},
      {"returns", counts_json(facts.returns)},
      {"classes", counts_json(facts.classes)},
      {"time", time_json(facts)},
      {"field", {{"area_m", density.field}, {"area_m2", density.area_m2}}},
      {"density_per_m2",
       {{"median", density.median},
        {"least_5_percent", density.least5},
        {"square_m", density.square_m}}},
      {"can_carry_plots", report.obstacles.empty()},
      {"obstacles", report.obstacles},
      {"doubts", report.doubts}};
}

}  // namespace plotscan::inspect
