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

// What there is of " [required; RANGE; default: ...; only with ...; not with ...]"; else empty. A
// default that the description states is left out.
std::string notes_of(const CLI::Option& option);

// In the name of an option's type, in front of its range: "INT:INT in [0 - 255]" as CLI11 states
// it, "INT in [0, 255]" as settings do.
inline constexpr const char* kRange = " in [";

}  // namespace plotscan
