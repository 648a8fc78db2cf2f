// SPDX-License-Identifier: Apache-2.0
#include "crop/cultivar.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan::crop {

std::string Parameter::allowed() const {
  return (whole() ? "a whole number in " : "a number in ") + range.text();
}

const Stage& Cultivar::stage(const std::string& name) const {
  const std::string& wanted = name.empty() ? default_stage : name;
  const auto found = std::ranges::find(stages, wanted, &Stage::name);
  if (found != stages.end()) return *found;
  throw InputError(fmt::format("stage {} is not one of {}'s, which are {}", wanted, crop,
                               joined(list_of(stages, &Stage::name), ", ")));
}

namespace {

const Parameter& parameter_named(const Cultivar& cultivar, const std::string& assignment) {
  const std::string name = assignment.substr(0, assignment.find('='));
  const auto found = std::ranges::find(cultivar.parameters, name, &Parameter::name);
  if (found != cultivar.parameters.end()) return *found;
  throw InputError(fmt::format("--set {}: {} is not a known key; known are {}", assignment, name,
                               joined(list_of(cultivar.parameters, &Parameter::name), ", ")));
}

double assigned_value(const Parameter& parameter, const std::string& assignment) {
  const std::size_t begin = std::min(parameter.name.size() + 1, assignment.size());
  const auto value = parsed<double>(std::string_view(assignment).substr(begin));
  if (!value || !parameter.range.contains(*value) ||
      (parameter.whole() && *value != std::floor(*value))) {
    throw InputError(
        fmt::format("--set {}: {} is to be {}", assignment, parameter.name, parameter.allowed()));
  }
  return *value;
}

}  // namespace

Traits::Traits(const Cultivar& cultivar, const Stage& stage,
               const std::vector<std::string>& assignments) {
  for (const Parameter& parameter : cultivar.parameters) {
    values_[parameter.name] =
        parameter.by_stage ? stage.values.at(parameter.name) : parameter.value;
  }
  for (const std::string& assignment : assignments) {
    const Parameter& parameter = parameter_named(cultivar, assignment);
    values_[parameter.name] = assigned_value(parameter, assignment);
  }
}

double Traits::operator[](const std::string& name) const {
  const auto found = values_.find(name);
  check(found != values_.end(), "the crop's file has a parameter " + name);
  return found->second;
}

int Traits::count(const std::string& name) const { return static_cast<int>((*this)[name]); }

double Traits::radians(const std::string& name) const { return plotscan::radians((*this)[name]); }

double Traits::vary(double value, RandomStream& random) const {
  return value * (1 + (*this)["variation"] * random.uniform(-1, 1));
}

}  // namespace plotscan::crop
