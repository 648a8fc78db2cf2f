// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

// What a program's manual page and completion need to know of its declarations.
namespace plotscan {

std::vector<const CLI::App*> commands_of(const CLI::App& program);

// The options that --help shows, in the order of their declaration.
std::vector<const CLI::Option*> options_of(const CLI::App& app);

// The values that an option accepts, if they are a list of names; else empty.
std::vector<std::string> choices_of(const CLI::Option& option);

// "-o", "--output"; empty for a positional argument.
std::vector<std::string> flags_of(const CLI::Option& option);

bool takes_value(const CLI::Option& option);

// The option's default, if it has one that its description does not state; else empty.
std::string default_of(const CLI::Option& option);

}  // namespace plotscan
