// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// The content of a suite's page (docs/report-format.md): its table, and every plot's true heights
// beside each method's estimates.
nlohmann::json suite_document(const SuiteResult& result, const std::vector<TableRow>& table);

// Writes folder/report.html: the suite, and of each case the farm whose view (farm_view.h) lies in
// the folder.
void write_suite_page(const std::filesystem::path& folder, const SuiteResult& result,
                      const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
