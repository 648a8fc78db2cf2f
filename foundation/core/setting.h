// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/range.h"

// The kinds of options that methods have, the same for a command line, a suite or a manifest. A
// setting gives access to the member of the options that it sets, and knows its allowed values.
namespace plotscan {

// A member, or a member's member: member<&FlyOptions::wind, &WindOptions::from_deg>(options).
template <auto... Path, class Options>
auto& member(Options& options) {
  return (options.*....*Path);
}

// Every number in the value must lie in the range; an absent value is allowed.
template <class Options, class Value>
struct RangedSetting {
  Range range;
  Value& (*of)(Options&);
};
template <class Options>
using NumberSetting = RangedSetting<Options, double>;
template <class Options>
using OptionalSetting = RangedSetting<Options, std::optional<double>>;
template <class Options>
using WholeSetting = RangedSetting<Options, int>;
template <class Options>
using OptionalWholeSetting = RangedSetting<Options, std::optional<int>>;
template <class Options>
using WholesSetting = RangedSetting<Options, std::vector<int>>;
template <class Options>
using VectorSetting = RangedSetting<Options, Eigen::Vector3d>;

template <class Options, class Value>
struct ChosenSetting {
  std::vector<std::string> choices;  // empty: any text
  Value& (*of)(Options&);
};
template <class Options>
using TextSetting = ChosenSetting<Options, std::string>;
template <class Options>
using OptionalTextSetting = ChosenSetting<Options, std::optional<std::string>>;

template <class Options>
struct FlagSetting {
  bool& (*of)(Options&);
};

// A rectangle, x0, y0, x1, y1; its owner says which.
template <class Options>
struct AreaSetting {
  std::optional<std::array<double, 4>>& (*of)(Options&);
};

// The value of the setting in const options. `of` takes them mutable; nothing is written here.
template <class Setting, class Options>
const auto& value_of(const Setting& setting, const Options& options) {
  return setting.of(const_cast<Options&>(options));  // NOLINT(*-const-cast)
}

// The value as manifests hold it; null if it is not set.
template <class Value>
nlohmann::json setting_json(const Value& value) {
  return value;
}
template <class Value>
nlohmann::json setting_json(const std::optional<Value>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}
nlohmann::json setting_json(const Eigen::Vector3d& value);

// Throw InputError, "NAME 200 must be in [0.5, 120]", "NAME \"x\" must be one of a, b".
void require_in_range(const std::string& name, double value, const Range& range);
template <class Number>
void require_in_range(const std::string& name, const std::optional<Number>& value,
                      const Range& range) {
  if (value) require_in_range(name, *value, range);
}
template <class Numbers>
requires std::ranges::range<Numbers>
void require_in_range(const std::string& name, const Numbers& values, const Range& range) {
  for (const double value : values) require_in_range(name, value, range);
}
void require_chosen(const std::string& name, const std::optional<std::string>& value,
                    const std::vector<std::string>& choices);

// Throws as above unless the setting's value is allowed.
template <class Options, class Value>
void require_valid(const std::string& name, const RangedSetting<Options, Value>& setting,
                   const Options& options) {
  require_in_range(name, value_of(setting, options), setting.range);
}
template <class Options, class Value>
void require_valid(const std::string& name, const ChosenSetting<Options, Value>& setting,
                   const Options& options) {
  require_chosen(name, value_of(setting, options), setting.choices);
}
template <class Setting, class Options>
void require_valid(const std::string&, const Setting&, const Options&) {}

// Read a value from its text: a number, numbers separated by commas, true or false. Throw
// InputError, "NAME \"x\" is not a number".
void read_setting(const std::string& name, const std::string& text, double& value);
void read_setting(const std::string& name, const std::string& text, int& value);
void read_setting(const std::string& name, const std::string& text, bool& value);
void read_setting(const std::string& name, const std::string& text, std::vector<int>& values);
void read_setting(const std::string& name, const std::string& text, std::array<double, 4>& values);
inline void read_setting(const std::string&, const std::string& text, std::string& value) {
  value = text;
}
template <class Value>
void read_setting(const std::string& name, const std::string& text, std::optional<Value>& value) {
  read_setting(name, text, value.emplace());
}

}  // namespace plotscan
