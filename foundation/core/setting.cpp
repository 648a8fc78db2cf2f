// SPDX-License-Identifier: Apache-2.0
#include "core/setting.h"

#include <algorithm>
#include <string_view>

#include <fmt/core.h>

#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan {
namespace {

template <class Number>
Number number_of(const std::string& name, std::string_view text, const char* kind) {
  const auto value = parsed<Number>(text);
  if (!value) throw InputError(fmt::format("{} \"{}\" is not {}", name, text, kind));
  return *value;
}

template <class Number>
std::vector<Number> numbers_of(const std::string& name, std::string_view text, const char* kind) {
  return list_of(split(text, ','),
                 [&](const std::string& part) { return number_of<Number>(name, part, kind); });
}

}  // namespace

nlohmann::json setting_json(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}

void require_in_range(const std::string& name, double value, const Range& range) {
  if (range.contains(value)) return;
  throw InputError(fmt::format("{} {} must be in {}", name, format_number(value), range.text()));
}

void require_chosen(const std::string& name, const std::optional<std::string>& value,
                    const std::vector<std::string>& choices) {
  if (!value || choices.empty() || contains(choices, *value)) return;
  throw InputError(fmt::format("{} \"{}\" must be one of {}", name, *value, joined(choices, ", ")));
}

void read_setting(const std::string& name, const std::string& text, double& value) {
  value = number_of<double>(name, text, "a number");
}

void read_setting(const std::string& name, const std::string& text, int& value) {
  value = number_of<int>(name, text, "a whole number");
}

void read_setting(const std::string& name, const std::string& text, bool& value) {
  require_chosen(name, text, {"true", "false"});
  value = text == "true";
}

void read_setting(const std::string& name, const std::string& text, std::vector<int>& values) {
  values = numbers_of<int>(name, text, "whole numbers with commas");
}

void read_setting(const std::string& name, const std::string& text, std::array<double, 4>& values) {
  const std::vector<double> numbers = numbers_of<double>(name, text, "four numbers with commas");
  if (numbers.size() != values.size())
    throw InputError(fmt::format("{} \"{}\" is not four numbers with commas", name, text));
  std::ranges::copy(numbers, values.begin());
}

}  // namespace plotscan
