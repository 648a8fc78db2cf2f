// SPDX-License-Identifier: Apache-2.0
#include "core/setting.h"

#include <algorithm>
#include <string_view>

#include "core/csv.h"
#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan {
namespace {

template <class Number>
Number number_of(const std::string& name, std::string_view text, const char* kind) {
  const auto value = parsed<Number>(text);
  if (!value) throw InputError(name + " \"" + std::string(text) + "\" is not " + kind);
  return *value;
}

template <class Number>
std::vector<Number> numbers_of(const std::string& name, std::string_view text, const char* kind) {
  std::vector<Number> values;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    values.push_back(number_of<Number>(name, text.substr(begin, comma - begin), kind));
    if (comma == std::string_view::npos) return values;
    begin = comma + 1;
  }
}

}  // namespace

nlohmann::json setting_json(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}

void require_in_range(const std::string& name, double value, const Range& range) {
  if (range.contains(value)) return;
  throw InputError(name + " " + format_number(value) + " must be in " + range.text());
}

void require_in_range(const std::string& name, const std::optional<double>& value,
                      const Range& range) {
  if (value) require_in_range(name, *value, range);
}

void require_in_range(const std::string& name, const std::optional<int>& value,
                      const Range& range) {
  if (value) require_in_range(name, static_cast<double>(*value), range);
}

void require_in_range(const std::string& name, const std::vector<int>& values, const Range& range) {
  for (const int value : values) require_in_range(name, static_cast<double>(value), range);
}

void require_in_range(const std::string& name, const Eigen::Vector3d& values, const Range& range) {
  for (const double value : values) require_in_range(name, value, range);
}

void require_chosen(const std::string& name, const std::optional<std::string>& value,
                    const std::vector<std::string>& choices) {
  if (!value || choices.empty() || std::ranges::count(choices, *value) > 0) return;
  throw InputError(name + " \"" + *value + "\" must be one of " + joined(choices, ", "));
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
    throw InputError(name + " \"" + text + "\" is not four numbers with commas");
  std::ranges::copy(numbers, values.begin());
}

}  // namespace plotscan
