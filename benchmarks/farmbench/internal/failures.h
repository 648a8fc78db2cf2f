// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// A line for each method and case where a method gave up, or says why it found no plots among those
// that are there, with how often and what it said the first time: "mine, flat: 2 of 10 farms, took
// more than 60 s and was stopped". Nothing where there is none.

// As a Markdown list under the heading.
std::string failure_list(const std::string& heading, const SuiteResult& result);

// The same for a terminal, after the lines.
void add_failures(const SuiteResult& result, std::vector<std::string>& lines);

}  // namespace plotscan::farmbench
