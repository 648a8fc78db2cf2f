// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/setting.h"
#include "core/text.h"
#include "plotscan/settings.h"

// The rooms' tables of settings (lidar/fly_settings.h, methods/*/settings.h) as the library shows
// and takes them, whatever their options.
namespace plotscan::boundary {

SettingValue outer(double value);
SettingValue outer(int value);
SettingValue outer(bool value);
SettingValue outer(const std::string& value);
SettingValue outer(const std::vector<int>& values);
SettingValue outer(const std::array<double, 4>& values);
SettingValue outer(const Eigen::Vector3d& values);
template <class Value>
std::optional<SettingValue> outer(const std::optional<Value>& value) {
  return value ? std::optional(outer(*value)) : std::nullopt;
}

// Throw InputError, "NAME is a whole number", when the value is of another kind.
void take(const std::string& name, const SettingValue& given, double& value);
void take(const std::string& name, const SettingValue& given, int& value);
void take(const std::string& name, const SettingValue& given, bool& value);
void take(const std::string& name, const SettingValue& given, std::string& value);
void take(const std::string& name, const SettingValue& given, std::vector<int>& values);
void take(const std::string& name, const SettingValue& given, std::array<double, 4>& values);
void take(const std::string& name, const SettingValue& given, Eigen::Vector3d& values);
template <class Value>
void take(const std::string& name, const SettingValue& given, std::optional<Value>& value) {
  take(name, given, value.emplace());
}

// Every setting of a table, with its value in the options.
template <class TableEntry, class Options>
std::vector<Setting> outer(const std::vector<TableEntry>& table, const Options& usual) {
  std::vector<Setting> settings;
  for (const TableEntry& entry : table) {
    Setting setting{.key = entry.key, .help = entry.help};
    std::visit(
        [&](const auto& value) {
          setting.usual = outer(value_of(value, usual));
          if constexpr (requires { value.choices; }) setting.choices = value.choices;
        },
        entry.value);
    settings.push_back(std::move(setting));
  }
  return settings;
}

// Sets the given values, by their keys, in the options of a "flight" or a method; ranges are
// checked when the work begins. Throws InputError on a key that is not in the table, and as the
// functions `take` above.
template <class TableEntry, class Options>
void take(const std::string& owner, const std::map<std::string, SettingValue>& given,
          const std::vector<TableEntry>& table, Options& options) {
  for (const auto& entry : given) {
    const std::string& key = entry.first;
    const auto found = std::ranges::find(table, key, &TableEntry::key);
    if (found == table.end()) {
      throw InputError(fmt::format("{} has no \"{}\"; it has {}", owner, key,
                                   joined(list_of(table, &TableEntry::key), ", ")));
    }
    const std::string name = fmt::format("{}'s {}", owner, key);
    std::visit([&](const auto& setting) { take(name, entry.second, setting.of(options)); },
               found->value);
  }
}

}  // namespace plotscan::boundary
