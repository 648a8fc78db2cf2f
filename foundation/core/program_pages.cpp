// SPDX-License-Identifier: Apache-2.0
#include "core/program_pages.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/manifest.h"
#include "core/text.h"

namespace plotscan {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

// Those that --help shows.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

// The values that an option takes, where they are named; CLI11 has them as "TEXT:{a,b}".
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto begin = type.find(":{");
  const auto end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::string choices = type.substr(begin + 2, end - begin - 2);
  std::ranges::replace(choices, ',', ' ');
  return choices;
}

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  return flags;
}

// Text as roff takes it: hyphens that can be copied, no line that begins like a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\\')
      escaped += "\\e";
    else if (letter == '-')
      escaped += "\\-";
    else if (letter == '\n')
      escaped += "\n.br\n";
    else
      escaped += letter;
  }
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
  return escaped;
}

std::string entry(const CLI::Option& option) {
  const bool positional = option.get_positional();
  std::string name = positional ? option.get_name(true) : joined(flags_of(option), ", ");
  std::string page = ".TP\n.B " + roff(name) + "\n" + roff(option.get_description());
  const std::string choices = choices_of(option);
  if (!choices.empty()) page += "; one of " + roff(choices);
  const std::string usual = option.get_default_str();
  const bool has_usual = !usual.empty() && usual != "[]" && option.get_items_expected_max() > 0;
  if (has_usual) page += "; by default " + roff(usual);
  page += "\n";
  return page;
}

std::string section(const CLI::App& command) {
  std::string page =
      ".SS " + roff(command.get_name()) + "\n" + roff(command.get_description()) + "\n";
  // CLI11 keeps the order of declaration; groups are told together, as --help does.
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

// What bash_completion offers, as the branches of its `case`.
struct Completions {
  std::string commands;  // every command
  std::string choices;   // by command and option
  std::string flags;     // by command
};

Completions completions_of(const CLI::App& program) {
  Completions offered;
  for (const CLI::App* command : commands_of(program)) {
    const std::string& name = command->get_name();
    offered.commands += name + " ";
    offered.flags += "    " + name + ",-*) words='";
    for (const CLI::Option* option : options_of(*command)) {
      const std::string values = choices_of(*option);
      for (const std::string& flag : flags_of(*option)) {
        offered.flags.append(flag).append(" ");
        if (values.empty()) continue;
        offered.choices.append("    ").append(name).append(",").append(flag);
        offered.choices.append(") words='").append(values).append("' ;;\n");
      }
    }
    offered.flags += "' ;;\n";
  }
  return offered;
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
    for (const CLI::Option* option : options_of(*command)) {
      if (option->get_positional()) page += " \\fI" + roff(option->get_name(true)) + "\\fR";
    }
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

std::string bash_completion(const CLI::App& program) {
  const std::string& name = program.get_name();
  const Completions offered = completions_of(program);
  // Words that nothing is known of are completed as files.
  return "# Completes " + name + " in bash; made from its declarations.\n_" + name +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words=''\n"
         "  if ((COMP_CWORD == 1)); then\n    words='" +
         offered.commands +
         "--help --version'\n"
         "  else\n    case ${COMP_WORDS[1]},$before in\n" +
         offered.choices + "    *) case ${COMP_WORDS[1]},$word in\n" + offered.flags +
         "    esac ;;\n    esac\n  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n}\n"
         "complete -o default -F _" +
         name + " " + name + "\n";
}

}  // namespace plotscan
