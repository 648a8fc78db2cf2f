// SPDX-License-Identifier: Apache-2.0
#include "core/internal/program_pages.h"

#include <map>
#include <vector>

#include "core/internal/program_declarations.h"
#include "core/manifest.h"
#include "core/text.h"

namespace plotscan {
namespace {

// Escapes text for roff: hyphens can be copied from the page, and no line begins like a request.
std::string roff(const std::string& text) {
  std::string page = with_escapes(text, {{'\\', "\\e"}, {'-', "\\-"}, {'\n', "\n.br\n"}});
  if (page.starts_with('.') || page.starts_with('\'')) page.insert(0, "\\&");
  return page;
}

std::string entry(const CLI::Option& option) {
  const bool positional = option.get_positional();
  std::string name = positional ? option.get_name(true) : joined(flags_of(option), ", ");
  std::string page = ".TP\n.B " + roff(name) + "\n" + roff(option.get_description());
  const std::string choices = joined(choices_of(option), " ");
  if (!choices.empty()) page += "; one of " + roff(choices);
  page += roff(notes_of(option)) + "\n";
  return page;
}

std::string section(const CLI::App& command) {
  std::string page =
      ".SS " + roff(command.get_name()) + "\n" + roff(command.get_description()) + "\n";
  // CLI11 keeps the order of declaration; here the options of a group are collected, as in --help.
  std::vector<std::string> groups;
  std::map<std::string, std::string> entries;
  for (const CLI::Option* option : options_of(command)) {
    const std::string& group = option->get_group();
    if (!entries.contains(group)) groups.push_back(group);
    entries[group] += entry(*option);
  }
  for (const std::string& group : groups) {
    if (group != "Options") page += ".PP\n.I " + roff(group) + "\n";
    page += entries[group];
  }
  return page;
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  const std::string& name = program.get_name();
  std::string page = ".TH " + name + " 1 \"\" \"Plotscan " + version() + "\" \"Plotscan\"\n";
  std::string about = program.get_description();
  if (about.ends_with('.')) about.pop_back();
  page += ".SH NAME\n" + name + " \\- " + roff(about) + "\n";
  page += ".SH SYNOPSIS\n";
  for (const CLI::App* command : commands_of(program)) {
    page += ".B " + name + " " + roff(command->get_name()) + "\n[\\fIOPTION\\fR]...";
    for (const CLI::Option* option : options_of(*command))
      if (option->get_positional()) page += " \\fI" + roff(option->get_name(true)) + "\\fR";
    page += "\n.br\n";
  }
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) page += section(*command);
  page +=
      ".SH EXIT STATUS\n0 done, 2 bad input or usage, 3 nothing to measure, 1 anything else.\n"
      ".SH ENVIRONMENT\n.TP\n.B PLOTSCAN_DATA\n"
      "The folder of worlds, models and suites, in place of the installed one.\n";
  return page;
}

}  // namespace plotscan
