// SPDX-License-Identifier: Apache-2.0
#include "core/internal/program_declarations.h"

#include <algorithm>
#include <set>

#include "core/list_of.h"
#include "core/text.h"

namespace plotscan {
namespace {

// The option's default, if it has one that its description does not state; else empty.
std::string default_of(const CLI::Option& option) {
  const std::string usual = option.get_default_str();
  const bool stated = option.get_description().find("default") != std::string::npos;
  return !takes_value(option) || stated || usual == "[]" ? "" : usual;
}

std::string range_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(kRange);
  if (begin == std::string::npos) return "";
  const std::size_t low = begin + std::string(kRange).size();
  std::string range = type.substr(low, type.find(']', low) - low);
  for (const std::string between : {" - ", ", "}) {
    const std::size_t middle = range.find(between);
    if (middle != std::string::npos) return range.replace(middle, between.size(), " to ");
  }
  return "";
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names =
      list_of(options, [](const auto* each) { return each->get_name(); });
  std::ranges::sort(names);  // the set's order is that of their places in memory
  return joined(names, ", ");
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

// CLI11 states the choices in the type's name, as "TEXT:{a,b}".
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto begin = type.find(":{");
  const auto end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return split(std::string_view(type).substr(begin + 2, end - begin - 2), ',');
}

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  return flags;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string notes_of(const CLI::Option& option) {
  std::vector<std::string> notes;
  if (option.get_required() && !option.get_positional()) notes.push_back("required");
  const std::string range = range_of(option);
  if (!range.empty()) notes.push_back(range);
  const std::string usual = default_of(option);
  if (!usual.empty()) notes.push_back("default: " + usual);
  const std::string needed = names_of(option.get_needs());
  if (!needed.empty()) notes.push_back("only with " + needed);
  const std::string others = names_of(option.get_excludes());
  if (!others.empty()) notes.push_back("not with " + others);
  return notes.empty() ? "" : " [" + joined(notes, "; ") + "]";
}

}  // namespace plotscan
