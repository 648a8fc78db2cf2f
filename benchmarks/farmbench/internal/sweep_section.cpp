// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/sweep_section.h"

#include <algorithm>
#include <set>

#include "core/contains.h"
#include "core/list_of.h"
#include "core/text.h"
#include "farmbench/internal/flight_section.h"
#include "farmbench/methods.h"
#include "score/height_score.h"

namespace plotscan::farmbench {
namespace {

constexpr std::size_t kMostValues = 100;
constexpr std::size_t kMostCombinations = 1000;
constexpr std::string_view kFileCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";

// Options of one number or name can be an axis.
bool can_vary(const lidar::FlySetting& setting) {
  return !std::holds_alternative<lidar::VectorSetting>(setting.value);
}

const lidar::FlySetting& setting_of(const YamlSection& axes, const std::string& key) {
  const auto& settings = lidar::fly_settings();
  const auto found = std::ranges::find(settings, key, &lidar::FlySetting::key);
  if (found != settings.end() && can_vary(*found)) return *found;
  axes.fail(key, "is no option of a flight that can vary; these can: {}",
            joined(list_of(those_of(settings, can_vary), &lidar::FlySetting::key), ", "));
}

// A value as a part of a file's name: of a sensor's own file, that file's name.
std::string name_of(const nlohmann::json& value) {
  std::string name = text_of(value);
  if (value.is_string()) name = std::filesystem::path(name).stem().string();
  std::ranges::replace_if(
      name, [](char c) { return kFileCharacters.find(c) == std::string_view::npos; }, '-');
  return name;
}

// Every case with each of the values of one axis.
std::vector<SuiteCase> varied(const YamlSection& axes, const std::vector<SuiteCase>& cases,
                              SweepAxis& axis) {
  const lidar::FlySetting& setting = setting_of(axes, axis.key);
  const std::vector<YamlSection> entries = axes.list(axis.key, kMostValues, axis.key);
  std::vector<SuiteCase> all;
  for (const SuiteCase& one : cases) {
    axis.values.clear();
    for (const YamlSection& entry : entries) {
      SuiteCase with = one;
      read_fly_setting(entry, setting, with.flight);
      const nlohmann::json value = lidar::settings_json(with.flight).at(axis.key);
      if (contains(axis.values, value)) axes.fail(axis.key, "name " + text_of(value) + " twice");
      axis.values.push_back(value);
      with.name += (with.name.empty() ? "" : "_") + name_of(value);
      all.push_back(std::move(with));
    }
    if (all.size() > kMostCombinations)
      axes.fail(axis.key, "makes more than " + std::to_string(kMostCombinations) + " combinations");
  }
  return all;
}

// A flight's option is either what all flights have in common or an axis.
void require_given_once(const YamlSection& root, const YamlSection& axes) {
  if (!root.has("flight")) return;
  const YamlSection flight = root.section("flight");
  for (const std::string& key : axes.keys())
    if (flight.has(key)) axes.fail(key, "is given under flight as well; give one of the two");
}

void require_names(const YamlSection& root, const std::vector<SuiteCase>& cases) {
  std::set<std::string> names;
  for (const SuiteCase& suite_case : cases) {
    if (!names.insert(suite_case.name).second)
      root.fail("axes", "have two combinations whose files would be called " + suite_case.name);
  }
}

// The height that is asked about: "mean" where the first method has it.
std::string read_height(const YamlSection& root, const Suite& suite) {
  const std::string& name = suite.methods.front();
  if (contains(suite.commands, name, &CommandMethod::name)) return root.text("height", "mean");
  const std::vector<std::string> heights =
      list_of(method_named(name).heights, &MethodHeight::height);
  const std::size_t mean = std::ranges::find(heights, "mean") - heights.begin();
  return heights[root.choice("height", heights, mean < heights.size() ? mean : 0)];
}

// What the height is held against: the truth that it is named after, where there is one.
std::string read_height_truth(const YamlSection& root, const std::string& height) {
  const std::vector<std::string>& truths = known_truths();
  const auto own = std::ranges::find(truths, score::named_truth(height));
  if (own == truths.end()) return truths[root.choice("truth", truths)];
  return truths[root.choice("truth", truths, own - truths.begin())];
}

SweepGoal read_goal(const YamlSection& section) {
  return {.rmse_m = section.number("rmse_cm", {0, 1000}) / 100,
          .found = section.number("found", {0, 1})};
}

}  // namespace

void read_sweep(const YamlSection& root, const SuiteCase& base, Suite& suite) {
  Sweep sweep;
  sweep.height = read_height(root, suite);
  sweep.truth = read_height_truth(root, sweep.height);
  if (root.has("enough")) sweep.goal = read_goal(root.section("enough"));
  const YamlSection axes = root.section("axes");
  require_given_once(root, axes);
  suite.cases = {base};
  suite.cases.front().name.clear();
  for (const std::string& key : axes.keys()) {
    sweep.axes.push_back({key, {}});
    suite.cases = varied(axes, suite.cases, sweep.axes.back());
  }
  if (sweep.axes.empty())
    root.fail("axes", "are none: name options of the flight and their values");
  require_names(root, suite.cases);
  suite.sweep = std::move(sweep);
}

}  // namespace plotscan::farmbench
