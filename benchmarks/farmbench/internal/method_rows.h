// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/methods.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// Heights of a method, each with its row, "lattice/max true-boxes": of a method's name, what comes
// after its first word follows the height.
std::vector<MethodHeight> rows_of(const std::string& method,
                                  const std::vector<std::string>& heights);

// The heights of one of the result's methods and their rows in tables: a known method's own, else
// those that an entered one gave of any plot. Of one that gave none, a single row called as the
// method, without a height.
std::vector<MethodHeight> heights_of(const SuiteResult& result, const std::string& method);

// Throws InputError where a method of the result is neither known nor entered, or is named twice.
void require_methods(const SuiteResult& result);

}  // namespace plotscan::farmbench
