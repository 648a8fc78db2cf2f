// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "core/internal/program_declarations.h"
#include "core/internal/program_pages.h"
#include "core/text.h"

namespace plotscan {
namespace {

std::string head(const CLI::App& program, const std::string& shell) {
  return "# Completes " + program.get_name() + " in " + shell + "; made from its declarations.\n";
}

bool is_number(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

// The branches of the `case` statements in bash_completion's script.
struct BashBranches {
  std::string commands;  // every command
  std::string choices;   // by command and option
  std::string flags;     // by command
};

BashBranches bash_branches(const CLI::App& program) {
  BashBranches offered;
  for (const CLI::App* command : commands_of(program)) {
    const std::string& name = command->get_name();
    offered.commands += name + " ";
    offered.flags += "    " + name + ",-*) words='";
    for (const CLI::Option* option : options_of(*command)) {
      const std::string values = joined(choices_of(*option), " ");
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

// Text for zsh's single quotes, in which there is no escape: a quote closes and reopens them.
std::string zsh_text(const std::string& text) {
  return with_escapes(text,
                      {{'\\', "\\\\"}, {':', "\\:"}, {'[', "\\["}, {']', "\\]"}, {'\'', "'\\''"}});
}

// Text for fish's single quotes.
std::string fish_text(const std::string& text) {
  return with_escapes(text, {{'\\', "\\\\"}, {'\'', "\\'"}});
}

// The value of an option or a positional argument, in the syntax of zsh's _arguments.
std::string zsh_value(const CLI::Option& option) {
  const std::vector<std::string> choices = choices_of(option);
  const std::string action = !choices.empty()    ? "(" + joined(choices, " ") + ")"
                             : is_number(option) ? " "
                                                 : "_files";
  const std::string name =
      option.get_positional() ? option.get_name(true) : option.get_lnames().front();
  return ":" + zsh_text(name) + ":" + action;
}

// An option's line for zsh's _arguments: what it excludes (its own other names too), its names and
// its description.
std::string zsh_argument(const CLI::Option& option) {
  if (option.get_positional())
    return " '" + std::string(takes_many(option) ? "*" : "") + zsh_value(option) + "'";
  const std::vector<std::string> flags = flags_of(option);
  std::vector<std::string> excluded;
  if (!takes_many(option)) excluded = flags;
  for (const CLI::Option* other : option.get_excludes())
    for (const std::string& flag : flags_of(*other)) excluded.push_back(flag);
  std::ranges::sort(excluded);  // CLI11 orders them by address
  std::string lines;
  for (const std::string& flag : flags) {
    lines += " '";
    if (!excluded.empty()) lines += "(" + joined(excluded, " ") + ")";
    if (takes_many(option)) lines += "*";
    lines += flag;
    if (takes_value(option)) lines += flag.starts_with("--") ? "=" : "+";
    lines += "[" + zsh_text(option.get_description()) + "]";
    if (takes_value(option)) lines += zsh_value(option);
    lines += "'";
  }
  return lines;
}

// The words of fish's `complete` for an option's names.
std::string fish_names(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += " -s " + name;
  for (const std::string& name : option.get_lnames()) names += " -l " + name;
  return names;
}

std::string fish_argument(const CLI::Option& option) {
  std::string line = fish_names(option);
  const std::vector<std::string> choices = choices_of(option);
  if (!choices.empty())
    line += " -x -a '" + joined(choices, " ") + "'";
  else if (takes_value(option))
    line += is_number(option) ? " -x" : " -r";
  return line + " -d '" + fish_text(option.get_description()) + "'";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  const std::string& name = program.get_name();
  const BashBranches offered = bash_branches(program);
  return head(program, "bash") + "_" + name +
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

std::string zsh_completion(const CLI::App& program) {
  const std::string& name = program.get_name();
  std::string script =
      "#compdef " + name + "\n" + head(program, "zsh") +
      "local context state state_descr line\nlocal -A opt_args\nlocal -a commands=(\n";
  for (const CLI::App* command : commands_of(program))
    script += "  '" + command->get_name() + ":" + zsh_text(command->get_description()) + "'\n";
  script += ")\n_arguments -C";
  for (const CLI::Option* option : options_of(program)) script += zsh_argument(*option);
  script +=
      " ':command:->command' '*::argument:->argument'\n"
      "case $state in\ncommand) _describe command commands ;;\n"
      "argument)\n  case $line[1] in\n";
  for (const CLI::App* command : commands_of(program)) {
    script += "  " + command->get_name() + ") _arguments -s";
    for (const CLI::Option* option : options_of(*command))
      script += " \\\n   " + zsh_argument(*option);
    script += " ;;\n";
  }
  return script + "  esac ;;\nesac\n";
}

std::string fish_completion(const CLI::App& program) {
  const std::string& name = program.get_name();
  // Tests which command is on the line; fish's own test also accepts a folder of that name.
  const std::string is = "__" + name + "_command_is";
  std::string script =
      head(program, "fish") + "function " + is +
      "\n  set -l words (commandline -opc) ''\n  test \"$words[2]\" = \"$argv\"\nend\n";
  const auto complete = [&](const std::string& command, const std::string& what) {
    script += "complete -c " + name + " -n '" + is + " \"" + command + "\"'" + what + "\n";
  };
  for (const CLI::Option* option : options_of(program)) complete("", fish_argument(*option));
  for (const CLI::App* command : commands_of(program)) {
    const std::string& word = command->get_name();
    complete("", " -f -a " + word + " -d '" + fish_text(command->get_description()) + "'");
    for (const CLI::Option* option : options_of(*command))
      if (!option->get_positional()) complete(word, fish_argument(*option));
  }
  return script;
}

}  // namespace plotscan
