// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace plotscan {

// A program's page for man(1), section 1, from the declarations of its commands and options.
std::string manual_page(const CLI::App& program);

// Scripts that complete a program's commands, options and their choices, from its declarations.
// Other words are completed as file names, except where a number is expected.
std::string bash_completion(const CLI::App& program);
// Shows descriptions, too. The script goes to a file _PROGRAM in a folder of zsh's fpath.
std::string zsh_completion(const CLI::App& program);
// Shows descriptions, too.
std::string fish_completion(const CLI::App& program);

}  // namespace plotscan
