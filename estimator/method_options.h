// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "core/program.h"
#include "methods/run.h"

namespace plotscan {

// The methods' settings given on the command line: option name -> text of its value.
using GivenSettings = std::map<std::string, std::string>;

// Adds an option for each setting of the methods that has one. `given` must outlive `command`.
void declare_methods(CLI::App& command, GivenSettings& given);

// Sets what was given in the options of the method that they name. Throws InputError on a value
// that the setting cannot have, and on an option of another method, which would have no effect.
void take_settings(const GivenSettings& given, methods::RunOptions& options);

}  // namespace plotscan
