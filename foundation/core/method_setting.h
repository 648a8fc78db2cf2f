// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/setting.h"

namespace plotscan {

// One option of a method. The command line, suites and manifests all take it from this one table.
template <class Options>
struct MethodSetting {
  std::string key;   // in suites and manifests, "plot_width_m"
  std::string flag;  // on the command line, "--plot-width"; "" where it has no option
  std::string help;  // meaning, unit, default
  std::variant<NumberSetting<Options>, OptionalSetting<Options>, WholeSetting<Options>,
               OptionalWholeSetting<Options>, WholesSetting<Options>, OptionalTextSetting<Options>,
               FlagSetting<Options>, AreaSetting<Options>>
      value;
  bool searches = false;  // has no effect when the plots' boxes are given
  bool measures = false;  // has no effect on which plots are found
};

// Sets the option to the value that the text states. Throws InputError, beginning with `name`, when
// the text is no such value, or the value is outside the setting's range or choices.
template <class Options>
void assign(const MethodSetting<Options>& setting, const std::string& name, const std::string& text,
            Options& options) {
  std::visit(
      [&](const auto& value) {
        read_setting(name, text, value.of(options));
        require_valid(name, value, options);
      },
      setting.value);
}

// The value of every setting by its key; null where it is not set.
template <class Options>
nlohmann::json settings_json(const std::vector<MethodSetting<Options>>& settings,
                             const Options& options) {
  nlohmann::json document = nlohmann::json::object();
  for (const MethodSetting<Options>& setting : settings)
    document[setting.key] = std::visit(
        [&](const auto& value) { return setting_json(value_of(value, options)); }, setting.value);
  return document;
}

// Throws InputError, naming the key, when a value is not in its setting's range or choices.
template <class Options>
void require_settings(const std::vector<MethodSetting<Options>>& settings, const Options& options) {
  for (const MethodSetting<Options>& setting : settings)
    std::visit([&](const auto& value) { require_valid(setting.key, value, options); },
               setting.value);
}

}  // namespace plotscan
