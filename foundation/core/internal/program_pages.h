// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace plotscan {

// A program's page for man(1), section 1, from the declarations of its commands and options.
std::string manual_page(const CLI::App& program);

}  // namespace plotscan
