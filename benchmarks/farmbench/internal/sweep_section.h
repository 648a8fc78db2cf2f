// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/yaml_section.h"
#include "farmbench/suite.h"

// Internal to .cpp files, as YamlSection is.
namespace plotscan::farmbench {

// Reads a suite's keys "axes", "height", "truth" and "enough", and puts a case for each combination
// of the axes' values into the suite, whose methods are read: copies of `base`. Throws InputError
// (file:line, key, what is allowed) on an axis that is no option of a flight or has a value twice,
// on more than 1000 combinations, and on a height that the first method does not have.
void read_sweep(const YamlSection& root, const SuiteCase& base, Suite& suite);

}  // namespace plotscan::farmbench
