// SPDX-License-Identifier: Apache-2.0
#include "crop/cultivar.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan::crop {

std::string Parameter::allowed() const {
  return (whole() ? "a whole number in " : "a number in ") + range.text();
}

const Stage& Cultivar::stage(const std::string& name) const {
  const std::string& wanted = name.empty() ? default_stage : name;
  std::vector<std::string> known;
  for (const Stage& each : stages) {
    if (each.name == wanted) return each;
    known.push_back(each.name);
  }
  throw InputError("stage " + wanted + " is not one of " + crop + "'s, which are " +
                   joined(known, ", "));
}

namespace {

const Parameter& parameter_named(const Cultivar& cultivar, const std::string& assignment) {
  const std::string name = assignment.substr(0, assignment.find('='));
  std::vector<std::string> known;
  for (const Parameter& parameter : cultivar.parameters) {
    if (name == parameter.name) return parameter;
    known.push_back(parameter.name);
  }
  throw InputError("--set " + assignment + ": " + name + " is not a known key; known are " +
                   joined(known, ", "));
}

double assigned_value(const Parameter& parameter, const std::string& assignment) {
  const std::size_t begin = std::min(parameter.name.size() + 1, assignment.size());
  const auto value = parsed<double>(std::string_view(assignment).substr(begin));
  if (!value || !parameter.range.contains(*value) ||
      (parameter.whole() && *value != std::floor(*value))) {
    throw InputError("--set " + assignment + ": " + parameter.name + " is to be " +
                     parameter.allowed());
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

}  // namespace plotscan::crop
