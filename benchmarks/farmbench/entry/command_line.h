// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace plotscan::farmbench {

// Splits a command at blanks; what stands in single or double quotes stays together and is taken as
// it is. No shell is involved: no other character has a special meaning. Throws InputError on an
// open quote and on a command without a word.
std::vector<std::string> split_command(const std::string& command);

// The words with every {name} replaced by its value, whatever that holds: a value with blanks or
// quotes stays one argument, and no braces in it are looked at. "{{" is one brace. Throws
// InputError on a name that has no value.
std::vector<std::string> substituted(const std::vector<std::string>& words,
                                     const std::map<std::string, std::string>& values);

// Whether any of the words names the place {name}.
bool names_place(const std::vector<std::string>& words, const std::string& name);

}  // namespace plotscan::farmbench
