// SPDX-License-Identifier: Apache-2.0
#include "farmbench/methods.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "core/text.h"
#include "farmbench/internal/method_rows.h"
#include "methods/dhami2020/settings.h"
#include "methods/lattice/settings.h"
#include "score/height_score.h"
#include "score/oracle_ground.h"

namespace plotscan::farmbench {
namespace {

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

// It gets the cloud and nothing else, or the true boxes to measure heights in.
Method lattice_method(const std::string& name, bool in_true_boxes,
                      const methods::lattice::Options& options) {
  return {
      .name = name, .heights = rows_of(name, height_names()), .estimate = [=](const Field& field) {
        methods::lattice::Options own = options;
        own.threads = field.threads;
        if (in_true_boxes) {
          own.boxes = list_of(field.plots, &score::TruePlot::box);
          own.trials = list_of(field.plots, &score::TruePlot::trial);
        }
        return methods::lattice::measure_field(field.found.with(own), own);
      }};
}

// The paper's pipeline: given the number of plots, it finds them; or it gets the true boxes.
Method dhami2020_method(const std::string& name, bool in_true_boxes,
                        const methods::dhami2020::Options& options) {
  return {.name = name,
          .heights = rows_of(name, {"voxel-max", "raw-max", "raw-p99"}),
          .estimate = [=](const Field& field) {
            methods::dhami2020::Options own = options;
            own.seed = field.seed;
            own.threads = field.threads;
            own.plots = in_true_boxes ? 0 : static_cast<int>(field.plots.size());
            if (in_true_boxes) own.boxes = list_of(field.plots, &score::TruePlot::box);
            return methods::dhami2020::estimate_plots(field.map, own);
          }};
}

// Sets "key=value" of the method's own settings.
template <class Options>
void set_word(const std::vector<MethodSetting<Options>>& settings, const std::string& word,
              Options& options) {
  const std::string key = word.substr(0, word.find('='));
  std::vector<std::string> keys;
  for (const MethodSetting<Options>& setting : settings) {
    keys.push_back(setting.key);
    if (setting.key == key && key != word)
      return assign(setting, key, word.substr(key.size() + 1), options);
  }
  throw InputError("\"" + word + "\" is not one of " + joined(keys, ", ") + " and its value");
}

template <class Options>
Options with_words(const std::vector<MethodSetting<Options>>& settings, std::istringstream& words) {
  Options options;
  for (std::string word; words >> word;) set_word(settings, word, options);
  return options;
}

}  // namespace

const std::vector<Method>& known_methods() {
  static const std::vector<Method> methods = {
      lattice_method("lattice", false, {}),
      lattice_method("lattice true-boxes", true, {}),
      dhami2020_method("dhami2020", false, {}),
      dhami2020_method("dhami2020 true-boxes", true, {}),
      {.name = "oracle-ground", .heights = {{"p99", "oracle-ground"}}, .estimate = oracle_ground},
      {.name = "one-number",
       .heights = rows_of("one-number", height_names()),
       .estimate = one_number}};
  return methods;
}

const std::vector<std::string>& known_truths() {
  static const std::vector<std::string> truths = [] {
    std::vector<std::string> all = {"height_hand3_m"};
    for (const std::string& name : height_names()) all.push_back(score::named_truth(name));
    return all;
  }();
  return truths;
}

Method method_named(const std::string& name) {
  const auto& methods = known_methods();
  const auto found = std::ranges::find(methods, name, &Method::name);
  if (found != methods.end()) return *found;
  std::istringstream words(name);
  std::string base;
  words >> base;
  const std::string boxed = base + std::string(kTrueBoxes);
  const bool in_true_boxes = name == boxed || name.starts_with(boxed + " ");
  if (in_true_boxes) words.ignore(static_cast<std::streamsize>(kTrueBoxes.size()));
  if (base == "lattice")
    return lattice_method(name, in_true_boxes, with_words(methods::lattice::settings(), words));
  if (base == "dhami2020")
    return dhami2020_method(name, in_true_boxes, with_words(methods::dhami2020::settings(), words));
  throw InputError("there is no method \"" + name + "\"; there are " +
                   joined(list_of(methods, &Method::name), ", "));
}

std::string method_name(const std::string& written) {
  std::istringstream words(written);
  std::string name;
  for (std::string word; words >> word;) name += (name.empty() ? "" : " ") + word;
  return name;
}

}  // namespace plotscan::farmbench
