// SPDX-License-Identifier: Apache-2.0
#include "farmbench/methods.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/statistics.h"
#include "core/text.h"
#include "estimate/dhami2020/dhami2020.h"
#include "estimate/lattice/lattice.h"
#include "farmbench/method_rows.h"
#include "score/height_score.h"
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

// What heights are named after in the truth and in the lattice method's rows.
const std::vector<std::string>& height_names() {
  static const std::vector<std::string> names = {"max", "mean", "p50",        "p90",
                                                 "p95", "p99",  "canopy_p95", "canopy_p99"};
  return names;
}

// One number for the whole field, and the best that there is: the mean of its plots' true heights.
estimate::Estimate one_number(const Field& field) {
  std::map<std::string, double> means_m;
  for (const std::string& name : height_names()) {
    std::vector<double> truths_m;
    for (const score::TruePlot& plot : field.plots) {
      const auto truth = plot.heights_m.find(score::named_truth(name));
      if (truth != plot.heights_m.end()) truths_m.push_back(truth->second);
    }
    if (!truths_m.empty()) means_m[name] = mean(truths_m);
  }
  estimate::Estimate estimate{.method = "one-number"};
  for (const score::TruePlot& plot : field.plots)
    estimate.plots.push_back({.id = plot.id, .box = plot.box, .heights_m = means_m});
  return estimate;
}

// The heights that have a truth of their name, in rows named after the method.
std::vector<MethodHeight> named_heights(const std::string& method) {
  std::vector<MethodHeight> heights;
  for (const std::string& name : height_names()) heights.push_back({name, row_name(method, name)});
  return heights;
}

}  // namespace

const std::vector<Method>& known_methods() {
  static const std::vector<Method> methods = {
      {.name = "lattice", .heights = named_heights("lattice"), .estimate = lattice},
      {.name = "lattice uncalibrated",
       .heights = named_heights("lattice uncalibrated"),
       .estimate = lattice_uncalibrated},
      {.name = "lattice true-boxes",
       .heights = named_heights("lattice true-boxes"),
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
      {.name = "oracle-ground", .heights = {{"p99", "oracle-ground"}}, .estimate = oracle_ground},
      {.name = "one-number", .heights = named_heights("one-number"), .estimate = one_number}};
  return methods;
}

const Method& method_named(const std::string& name) {
  const auto& methods = known_methods();
  const auto found = std::ranges::find(methods, name, &Method::name);
  check(found != methods.end(), "no method " + name);
  return *found;
}

void require_known_methods(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Method& method : known_methods()) known.push_back(method.name);
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) == 0)
      throw InputError("there is no method \"" + name + "\"; there are " + joined(known, ", "));
    if (std::ranges::count(names, name) > 1)
      throw InputError("the method \"" + name + "\" is named twice");
  }
}

}  // namespace plotscan::farmbench
