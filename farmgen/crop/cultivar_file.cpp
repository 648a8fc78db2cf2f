// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/contains.h"
#include "core/csv.h"
#include "core/list_of.h"
#include "core/text.h"
#include "core/yaml_section.h"
#include "crop/cultivar.h"

namespace plotscan::crop {
namespace {

constexpr double kHuge = 1e9;
constexpr Range kAnyNumber{-kHuge, kHuge};
constexpr std::size_t kMostStages = 100;

// Reads a crop's file, or a user's over it: then what the file leaves out stays as it is.
class CultivarFile {
 public:
  CultivarFile(const YamlSection& file, const Cultivar* base)
      : file_(file), complete_(base == nullptr), cultivar_(base == nullptr ? Cultivar{} : *base) {}

  Cultivar read() {
    const std::string crop = file_.text("crop");
    const std::string wanted = complete_ ? file_.file().stem().string() : cultivar_.crop;
    if (crop != wanted) file_.fail("crop", "is {}, but the plant is a {}", crop, wanted);
    cultivar_.crop = crop;
    cultivar_.species = text(file_, "species", cultivar_.species);
    if (given("sources")) sources_ = file_.section("sources").keys();
    if (given("plot")) read_plot(file_.section("plot"));
    if (given("colours")) read_colours(file_.section("colours"));
    if (file_.has("reflectance")) read_reflectance(file_.section("reflectance"));
    if (given("parameters")) read_parameters(file_.section("parameters"));
    if (given("stages"))
      for (const YamlSection& stage : file_.list("stages", kMostStages)) read_stage(stage);
    require_values_in_ranges();
    cultivar_.default_stage = text(file_, "default_stage", cultivar_.default_stage);
    stage_named(cultivar_.default_stage, file_, "default_stage");
    file_.refuse_unread();
    return std::move(cultivar_);
  }

 private:
  bool given(const std::string& key) const { return complete_ || file_.has(key); }

  std::string text(const YamlSection& section, const std::string& key,
                   const std::string& kept) const {
    return section.text(key, complete_ ? std::nullopt : std::optional(kept));
  }

  Range range(const YamlSection& section, const std::string& key, const Range& within,
              const Range& kept) const {
    if (!complete_ && !section.has(key)) return kept;
    const auto [low, high] = section.pair(key, within);
    if (low > high) section.fail(key, "has its larger end first");
    return {low, high};
  }

  // A source is one of the file's `sources`, or text that begins with one and a comma.
  std::string source(const YamlSection& section, const std::string& kept) const {
    std::string named = text(section, "source", kept);
    const std::string key = named.substr(0, named.find(','));
    if (complete_ && !contains(sources_, key)) {
      section.fail("source", "\"{}\" is not one of the file's sources, which are {}", key,
                   joined(sources_, ", "));
    }
    return named;
  }

  void read_plot(const YamlSection& plot) {
    const auto number = [&](const char* key, double kept) {
      return plot.number(key, {1e-3, 1e4}, complete_ ? std::nullopt : std::optional(kept));
    };
    cultivar_.plants_per_m2 = number("plants_per_m2", cultivar_.plants_per_m2);
    cultivar_.row_spacing_m = number("row_spacing_m", cultivar_.row_spacing_m);
    cultivar_.plot_source = source(plot, cultivar_.plot_source);
  }

  void require_material(const YamlSection& section, const std::string& name) const {
    if (cultivar_.colours.contains(name)) return;
    const auto materials =
        list_of(cultivar_.colours, [](const auto& named) { return named.first; });
    section.fail(name, "is not a material of {}, which has {}", cultivar_.crop,
                 joined(materials, ", "));
  }

  void read_colours(const YamlSection& colours) {
    for (const std::string& name : colours.keys()) {
      if (!complete_) require_material(colours, name);
      const std::vector<double> rgb = colours.numbers(name, 3, {0, 1});
      cultivar_.colours[name] = Eigen::Vector3d(rgb[0], rgb[1], rgb[2]).cast<float>();
    }
  }

  void read_reflectance(const YamlSection& reflectance) {
    for (const std::string& name : reflectance.keys()) {
      require_material(reflectance, name);
      cultivar_.reflectance[name] = static_cast<float>(reflectance.number(name, {0, 1}));
    }
  }

  void read_parameters(const YamlSection& parameters) {
    parameters.allow_only(complete_ ? parameters.keys()
                                    : list_of(cultivar_.parameters, &Parameter::name));
    for (const std::string& name : parameters.keys()) {
      if (complete_) cultivar_.parameters.push_back({.name = name, .range = kAnyNumber});
      const auto parameter = std::ranges::find(cultivar_.parameters, name, &Parameter::name);
      read_parameter(parameters.section(name), *parameter);
    }
  }

  void read_parameter(const YamlSection& section, Parameter& parameter) const {
    parameter.range = range(section, "range", parameter.range, parameter.range);
    const std::string unit = text(section, "unit", parameter.unit);
    if (!complete_ && unit != parameter.unit)
      section.fail("unit", "is {}, not {}", parameter.unit, unit);
    parameter.unit = unit;
    parameter.meaning = text(section, "meaning", parameter.meaning);
    parameter.source = source(section, parameter.source);
    if (complete_) parameter.by_stage = !section.has("value");
    if (!section.has("value")) return;
    if (parameter.by_stage) section.fail("value", "is given by each stage: set it under stages");
    parameter.value = value(section, "value", parameter);
  }

  static double value(const YamlSection& section, const std::string& key,
                      const Parameter& parameter) {
    const double number = section.number(key, parameter.range);
    if (parameter.whole() && number != std::floor(number))
      section.fail(key, "is to be {}", parameter.allowed());
    return number;
  }

  Stage& stage_named(const std::string& name, const YamlSection& section, const char* key) {
    const auto stage = std::ranges::find(cultivar_.stages, name, &Stage::name);
    if (stage == cultivar_.stages.end())
      section.fail(key, "\"{}\" is not a stage of {}, which has {}", name, cultivar_.crop,
                   joined(list_of(cultivar_.stages, &Stage::name), ", "));
    return *stage;
  }

  void read_stage(const YamlSection& section) {
    const std::string name = section.text("name");
    if (complete_) cultivar_.stages.push_back({.name = name});
    Stage& stage = stage_named(name, section, "name");
    stage.meaning = text(section, "meaning", stage.meaning);
    stage.height_m = range(section, "height_m", {0, 10}, stage.height_m);
    stage.leaf_area_index = range(section, "leaf_area_index", {0, 20}, stage.leaf_area_index);
    stage.leaf_inclination_deg =
        range(section, "leaf_inclination_deg", {0, 90}, stage.leaf_inclination_deg);
    stage.source = source(section, stage.source);
    if (complete_ || section.has("values")) read_values(section.section("values"), stage);
  }

  void read_values(const YamlSection& values, Stage& stage) const {
    std::vector<std::string> known;
    for (const Parameter& parameter : cultivar_.parameters)
      if (parameter.by_stage) known.push_back(parameter.name);
    values.allow_only(known);
    for (const Parameter& parameter : cultivar_.parameters) {
      if (!parameter.by_stage || !(complete_ || values.has(parameter.name))) continue;
      stage.values[parameter.name] = value(values, parameter.name, parameter);
    }
  }

  // A user's range may leave out a value of the crop's own that the file keeps.
  void require_values_in_ranges() const {
    for (const Parameter& parameter : cultivar_.parameters) {
      if (!parameter.by_stage) require_in_range(parameter, parameter.value);
      for (const Stage& stage : cultivar_.stages)
        if (parameter.by_stage) require_in_range(parameter, stage.values.at(parameter.name));
    }
  }

  void require_in_range(const Parameter& parameter, double value) const {
    if (parameter.range.contains(value)) return;
    file_.section("parameters")
        .section(parameter.name)
        .fail("range", "leaves out the crop's value {}: give another", format_number(value));
  }

  const YamlSection& file_;
  bool complete_;
  Cultivar cultivar_;
  std::vector<std::string> sources_;
};

}  // namespace

Cultivar parse_cultivar(const std::string& text, const std::filesystem::path& file) {
  const YamlSection section = YamlSection::parse(text, file);
  return CultivarFile(section, nullptr).read();
}

Cultivar override_cultivar(const Cultivar& cultivar, const std::filesystem::path& file) {
  const YamlSection section = YamlSection::load(file, {});
  return CultivarFile(section, &cultivar).read();
}

}  // namespace plotscan::crop
