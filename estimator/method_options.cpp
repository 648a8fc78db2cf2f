// SPDX-License-Identifier: Apache-2.0
#include "method_options.h"

#include <algorithm>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/method_setting.h"
#include "core/text.h"

namespace plotscan {
namespace {

template <class Options>
CLI::Option* shaped(CLI::Option* option, const NumberSetting<Options>& setting) {
  return option->type_name("FLOAT in " + setting.range.text())
      ->default_str(format_number(value_of(setting, Options{})));
}
template <class Options>
CLI::Option* shaped(CLI::Option* option, const OptionalSetting<Options>& setting) {
  return option->type_name("FLOAT in " + setting.range.text());
}
template <class Options>
CLI::Option* shaped(CLI::Option* option, const WholeSetting<Options>& setting) {
  return option->type_name("INT in " + setting.range.text())
      ->default_str(std::to_string(value_of(setting, Options{})));
}
template <class Options, class Value>
CLI::Option* shaped(CLI::Option* option, const RangedSetting<Options, Value>& setting) {
  return option->type_name("INT in " + setting.range.text());
}
template <class Options>
CLI::Option* shaped(CLI::Option* option, const OptionalTextSetting<Options>& setting) {
  return option->type_name("TEXT")->check(CLI::IsMember(setting.choices));
}
template <class Options>
CLI::Option* shaped(CLI::Option* option, const AreaSetting<Options>&) {
  return option->type_name("FLOAT,FLOAT,FLOAT,FLOAT");
}

template <class Setting>
CLI::Option* added(CLI::App& command, const std::string& flag, const std::string& help,
                   const Setting& setting, GivenSettings& given) {
  const auto take = [&given, flag](const std::string& text) { given[flag] = text; };
  return shaped(command.add_option_function<std::string>(flag, take, help), setting);
}

// "--no-level" turns `level` off.
template <class Options>
CLI::Option* added(CLI::App& command, const std::string& flag, const std::string& help,
                   const FlagSetting<Options>&, GivenSettings& given) {
  const char* text = flag.starts_with("--no-") ? "false" : "true";
  return command.add_flag_callback(
      flag, [&given, flag, text] { given[flag] = text; }, help);
}

// Adds the settings' options to the help group `group`, named after their method. An option that
// another method has as well moves to the group of --boxes.
template <class Options>
void declare(CLI::App& command, const std::vector<MethodSetting<Options>>& settings,
             const char* group, GivenSettings& given) {
  CLI::Option* boxes = command.get_option("--boxes");
  for (const MethodSetting<Options>& setting : settings) {
    if (setting.flag.empty()) continue;
    if (CLI::Option* shared = command.get_option_no_throw(setting.flag)) {
      shared->group(boxes->get_group());
      continue;
    }
    CLI::Option* option = std::visit(
        [&](const auto& value) { return added(command, setting.flag, setting.help, value, given); },
        setting.value);
    option->group(group);
    if (setting.searches) option->excludes(boxes);
  }
}

template <class Options>
const MethodSetting<Options>* with_flag(const std::vector<MethodSetting<Options>>& settings,
                                        const std::string& flag) {
  const auto found = std::ranges::find(settings, flag, &MethodSetting<Options>::flag);
  return found == settings.end() ? nullptr : &*found;
}

// The methods that have an option.
std::string owners_of(const std::string& flag) {
  std::vector<std::string> owners;
  const methods::RunOptions any;
  methods::for_each_method(any, [&](const char* name, const auto& settings, const auto&) {
    if (with_flag(settings, flag) != nullptr) owners.emplace_back(name);
  });
  return joined(owners, ", ");
}

template <class Options>
void take(const GivenSettings& given, const std::vector<MethodSetting<Options>>& settings,
          const std::string& method, Options& options) {
  for (const auto& [flag, text] : given) {
    const MethodSetting<Options>* setting = with_flag(settings, flag);
    if (setting == nullptr) {
      throw InputError(fmt::format("{} belongs to --method {}, and the method is {}", flag,
                                   owners_of(flag), method));
    }
    assign(*setting, flag, text, options);
  }
}

}  // namespace

void declare_methods(CLI::App& command, GivenSettings& given) {
  const methods::RunOptions any;
  methods::for_each_method(any, [&](const char* name, const auto& settings, const auto&) {
    declare(command, settings, name, given);
  });
}

void take_settings(const GivenSettings& given, methods::RunOptions& options) {
  methods::for_each_method(options, [&](const std::string& name, const auto& settings, auto& own) {
    if (name == options.method) take(given, settings, name, own);
  });
}

}  // namespace plotscan
