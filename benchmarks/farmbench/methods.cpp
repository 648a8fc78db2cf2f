// SPDX-License-Identifier: Apache-2.0
#include "farmbench/methods.h"

#include <algorithm>

#include "core/error.h"
#include "estimate/dhami2020/dhami2020.h"
#include "estimate/lattice/lattice.h"
#include "score/oracle_ground.h"

namespace plotscan::farmbench {
namespace {

std::vector<PlotBox> true_boxes(const Field& field) {
  std::vector<PlotBox> boxes;
  for (const score::TruePlot& plot : field.plots) boxes.push_back(plot.box);
  return boxes;
}

// The cloud and nothing else.
estimate::Estimate lattice(const Field& field) {
  return estimate::lattice(field.cloud, {.threads = field.threads});
}

// The same with the canopy's own quantiles for the plants'.
estimate::Estimate lattice_uncalibrated(const Field& field) {
  return estimate::lattice(field.cloud, {.calibrated = false, .threads = field.threads});
}

// Its heights alone, in the true boxes.
estimate::Estimate lattice_true_boxes(const Field& field) {
  return estimate::lattice(field.cloud, {.boxes = true_boxes(field), .threads = field.threads});
}

// The paper's pipeline: given the number of plots, it finds them.
estimate::Estimate dhami2020(const Field& field) {
  return estimate::dhami2020(field.map, {.plots = static_cast<int>(field.plots.size()),
                                         .seed = field.seed,
                                         .threads = field.threads});
}

// Its heights alone, in the true boxes.
estimate::Estimate dhami2020_true_boxes(const Field& field) {
  return estimate::dhami2020(
      field.map, {.boxes = true_boxes(field), .seed = field.seed, .threads = field.threads});
}

estimate::Estimate oracle_ground(const Field& field) {
  return score::oracle_ground(field.map, field.plots, field.terrain);
}

// "lattice/max true-boxes": of a method's name, what comes after its first word follows the height.
std::string row_name(const std::string& method, const std::string& height) {
  const std::size_t space = method.find(' ');
  if (space == std::string::npos) return method + "/" + height;
  return method.substr(0, space) + "/" + height + method.substr(space);
}

// The heights of the lattice method, in rows named after the method.
std::vector<MethodHeight> lattice_heights(const std::string& method) {
  std::vector<MethodHeight> heights;
  for (const char* name : {"max", "mean", "p50", "p90", "p95", "p99", "canopy_p95", "canopy_p99"}) {
    heights.push_back({name, row_name(method, name)});
  }
  return heights;
}

}  // namespace

const std::vector<Method>& known_methods() {
  static const std::vector<Method> methods = {
      {.name = "lattice", .heights = lattice_heights("lattice"), .estimate = lattice},
      {.name = "lattice uncalibrated",
       .heights = lattice_heights("lattice uncalibrated"),
       .estimate = lattice_uncalibrated},
      {.name = "lattice true-boxes",
       .heights = lattice_heights("lattice true-boxes"),
       .estimate = lattice_true_boxes},
      {.name = "dhami2020",
       .heights = {{"voxel-max", "dhami2020/voxel-max"},
                   {"raw-max", "dhami2020/raw-max"},
                   {"raw-p99", "dhami2020/raw-p99"}},
       .estimate = dhami2020},
      {.name = "dhami2020 true-boxes",
       .heights = {{"voxel-max", "dhami2020/voxel-max true-boxes"},
                   {"raw-max", "dhami2020/raw-max true-boxes"},
                   {"raw-p99", "dhami2020/raw-p99 true-boxes"}},
       .estimate = dhami2020_true_boxes},
      {.name = "oracle-ground", .heights = {{"p99", "oracle-ground"}}, .estimate = oracle_ground}};
  return methods;
}

const Method& method_named(const std::string& name) {
  const auto& methods = known_methods();
  const auto found = std::ranges::find(methods, name, &Method::name);
  check(found != methods.end(), "no method " + name);
  return *found;
}

std::set<std::string> heights_of(const Method& method) {
  std::set<std::string> names;
  for (const MethodHeight& height : method.heights) names.insert(height.height);
  return names;
}

}  // namespace plotscan::farmbench
