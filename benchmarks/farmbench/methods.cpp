// SPDX-License-Identifier: Apache-2.0
#include "farmbench/methods.h"

#include <algorithm>

#include "core/error.h"
#include "estimate/dhami2020/dhami2020.h"
#include "score/oracle_ground.h"

namespace plotscan::farmbench {
namespace {

// The paper's pipeline: given the number of plots, it finds them.
estimate::Estimate dhami2020(const Field& field) {
  return estimate::dhami2020(field.map, {.plots = static_cast<int>(field.plots.size()),
                                         .seed = field.seed,
                                         .threads = field.threads});
}

// Its heights alone, in the true boxes.
estimate::Estimate dhami2020_true_boxes(const Field& field) {
  estimate::Dhami2020Options options{.seed = field.seed, .threads = field.threads};
  for (const score::TruePlot& plot : field.plots) options.boxes.push_back(plot.box);
  return estimate::dhami2020(field.map, options);
}

estimate::Estimate oracle_ground(const Field& field) {
  return score::oracle_ground(field.map, field.plots, field.terrain);
}

}  // namespace

const std::vector<Method>& known_methods() {
  static const std::vector<Method> methods = {
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
