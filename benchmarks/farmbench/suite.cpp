// SPDX-License-Identifier: Apache-2.0
#include "farmbench/suite.h"

#include <algorithm>
#include <set>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/yaml_section.h"
#include "description/load_description.h"
#include "farmbench/entry/entered_plots.h"
#include "farmbench/internal/flight_section.h"
#include "farmbench/internal/sweep_section.h"
#include "farmbench/methods.h"

namespace plotscan::farmbench {
namespace {

constexpr std::size_t kMostCases = 1000;
constexpr std::size_t kMostMethods = 100;

// A name that can be part of a file's name and of a CSV field.
std::string read_name(const YamlSection& section) {
  std::string name = section.text("name");
  if (!is_table_name(name))
    section.fail("name", "\"" + name + "\" is not a name: 1 to 40 letters, digits, '-' and '_'");
  return name;
}

void require_farm(const YamlSection& section, const SuiteCase& suite_case) {
  try {
    description::load_description(suite_case.farm, suite_case.overrides);
  } catch (const InputError& error) {
    section.fail("farm", std::string("does not hold: ") + error.what());
  }
}

cloud::Area read_survey(const YamlSection& section) {
  const std::vector<double> numbers = section.numbers("survey_m", 4, {-100'000, 100'000});
  const cloud::Area area = {numbers[0], numbers[1], numbers[2], numbers[3]};
  try {
    cloud::require_area(area, "survey_m");
  } catch (const InputError& error) {
    section.fail("survey_m", std::string("does not hold: ") + error.what());
  }
  return area;
}

SuiteCase read_case(const YamlSection& section, const lidar::FlyOptions& flight) {
  SuiteCase suite_case{.name = read_name(section),
                       .farm = section.file().parent_path() / section.text("farm"),
                       .flight = read_flight(section, flight)};
  if (section.has("set")) {
    for (const auto& [key, value] : section.section("set").texts()) {
      suite_case.overrides.push_back(key);
      suite_case.overrides.back().append("=").append(value);
    }
  }
  if (section.has("survey_m")) suite_case.survey = read_survey(section);
  suite_case.without_plots = section.choice("without_plots", {"false", "true"}, 0) == 1;
  if (suite_case.without_plots && suite_case.survey)
    section.fail("survey_m", "is of plots, and the case is without_plots");
  require_farm(section, suite_case);
  return suite_case;
}

std::optional<double> read_published_rmse(const YamlSection& root, const YamlSection& section) {
  if (!section.has("published_rmse_cm")) return std::nullopt;
  if (!root.has("published"))
    section.fail("published_rmse_cm",
                 "is shown nowhere: the suite must say whose it is, published: {source: ..., "
                 "methods: [...]}");
  return section.number("published_rmse_cm", {0, 1000});
}

std::vector<SuiteCase> read_cases(const YamlSection& root) {
  const lidar::FlyOptions flight = read_flight(root, {});
  std::vector<SuiteCase> cases;
  std::set<std::string> names;
  for (const YamlSection& section : root.list("cases", kMostCases)) {
    cases.push_back(read_case(section, flight));
    cases.back().published_rmse_cm = read_published_rmse(root, section);
    if (!names.insert(cases.back().name).second)
      section.fail("name", "\"" + cases.back().name + "\" is the name of another case as well");
  }
  return cases;
}

// Either a list of seeds or {first, count}.
std::vector<std::uint64_t> read_seeds(const YamlSection& root) {
  std::vector<std::uint64_t> seeds;
  if (root.is_list("seeds")) {
    for (const YamlSection& entry : root.list("seeds", kMostSeeds, "seed")) {
      seeds.push_back(entry.unsigned_integer("seed"));
      if (std::ranges::count(seeds, seeds.back()) > 1)
        root.fail("seeds", "name " + std::to_string(seeds.back()) + " twice");
    }
    return seeds;
  }
  const YamlSection range = root.section("seeds");
  const auto first = static_cast<std::uint64_t>(range.integer("first", 0, 1'000'000'000));
  const std::int64_t count = range.integer("count", 1, kMostSeeds);
  for (std::int64_t i = 0; i < count; ++i) seeds.push_back(first + static_cast<std::uint64_t>(i));
  return seeds;
}

// A method's name, or a map from it to settings of its own, as one text.
std::string read_method(const YamlSection& entry) {
  const std::vector<std::string> keys = entry.keys();
  if (keys.size() != 1)
    entry.fail("", "has to be a method's name, name: {key: value}, or {name: ..., command: ...}");
  if (!entry.is_map(keys.front())) return entry.text("name");
  std::string name = keys.front();
  for (const auto& [key, value] : entry.section(keys.front()).texts())
    name.append(" ").append(key).append("=").append(value);
  return name;
}

// One of Plotscan's methods, with any of its settings.
std::string read_own_method(const YamlSection& root, const YamlSection& entry) {
  std::string name = method_name(read_method(entry));
  try {
    method_named(name);
  } catch (const InputError& error) {
    root.fail("methods", std::string("do not hold: ") + error.what());
  }
  return name;
}

CommandMethod read_command(const YamlSection& entry) {
  const std::string name = read_name(entry);
  if (contains(known_methods(), name, &Method::name))
    entry.fail("name", "\"" + name + "\" is one of Plotscan's methods");
  return read_command_method(entry, name);
}

void read_methods(const YamlSection& root, Suite& suite) {
  for (const YamlSection& entry : root.list("methods", kMostMethods, "name")) {
    if (entry.has("command")) {
      suite.commands.push_back(read_command(entry));
      suite.methods.push_back(suite.commands.back().name);
    } else {
      suite.methods.push_back(read_own_method(root, entry));
    }
    if (std::ranges::count(suite.methods, suite.methods.back()) > 1)
      root.fail("methods", "name \"" + suite.methods.back() + "\" twice");
  }
}

std::vector<std::string> read_truths(const YamlSection& root) {
  std::vector<std::string> truths;
  if (!root.has("truths")) return truths;
  for (const YamlSection& entry : root.list("truths", 100, "name")) {
    truths.push_back(known_truths()[entry.choice("name", known_truths())]);
    if (std::ranges::count(truths, truths.back()) > 1)
      root.fail("truths", "name " + truths.back() + " twice");
  }
  return truths;
}

// Whether the table can have rows of this name. Heights of a program are known when it has run.
bool has_row(const Suite& suite, const std::string& row) {
  for (const std::string& name : suite.methods) {
    if (contains(suite.commands, name, &CommandMethod::name)) {
      if (row.starts_with(name.substr(0, name.find(' ')) + "/")) return true;
    } else {
      const std::vector<MethodHeight> heights = method_named(name).heights;
      if (contains(heights, row, &MethodHeight::row)) return true;
    }
  }
  return false;
}

// Whose the cases' published figures are.
void read_published(const YamlSection& root, Suite& suite) {
  const YamlSection published = root.section("published");
  suite.published = {.source = published.text("source"), .methods = {}};
  for (const YamlSection& entry : published.list("methods", 100, "row")) {
    suite.published->methods.push_back(entry.text("row"));
    if (!has_row(suite, suite.published->methods.back()))
      published.fail(
          "methods",
          "name \"{}\", which is no row of the suite's methods, such as dhami2020/raw-p99",
          suite.published->methods.back());
  }
  const auto has_figure = [](const SuiteCase& suite_case) {
    return suite_case.published_rmse_cm.has_value();
  };
  if (std::ranges::none_of(suite.cases, has_figure))
    root.fail("published", "has no figures: no case has a published_rmse_cm");
}

// What the cases are compared with: one of them, and what somebody published.
void read_comparisons(const YamlSection& root, Suite& suite) {
  if (root.has("baseline")) {
    const std::vector<std::string> names = list_of(suite.cases, &SuiteCase::name);
    suite.baseline = names[root.choice("baseline", names)];
  }
  if (root.has("published")) read_published(root, suite);
}

}  // namespace

Suite load_suite(const std::filesystem::path& file) {
  const YamlSection root = YamlSection::load(file, {});
  Suite suite{.file = file,
              .name = read_name(root),
              .cases = {},
              .seeds = read_seeds(root),
              .methods = {},
              .truths = read_truths(root)};
  read_methods(root, suite);
  suite.crop_margin_m = root.number("crop_margin_m", {0, 100}, suite.crop_margin_m);
  if (root.has("axes")) {
    const SuiteCase base = read_case(root, {});  // the farm and flight that all cases share
    if (base.without_plots) root.fail("without_plots", "is of cases, and a sweep asks about plots");
    read_sweep(root, base, suite);
  } else {
    suite.cases = read_cases(root);
    read_comparisons(root, suite);
  }
  root.refuse_unread();
  return suite;
}

}  // namespace plotscan::farmbench
