// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

// What a program's manual page and completion read of its declarations.
namespace plotscan {

std::vector<const CLI::App*> commands_of(const CLI::App& program);

// Those that --help shows, in the order of their declaration.
std::vector<const CLI::Option*> options_of(const CLI::App& app);

// The values that an option takes, where they are named, else empty.
std::vector<std::string> choices_of(const CLI::Option& option);

// "-o", "--output"; none of a positional.
std::vector<std::string> flags_of(const CLI::Option& option);

bool takes_value(const CLI::Option& option);

// The default of an option that has one, where its description does not state it; else empty.
std::string default_of(const CLI::Option& option);

}  // namespace plotscan
