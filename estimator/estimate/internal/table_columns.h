// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/csv.h"

namespace plotscan::estimate {

// Whether two names are one, whatever their case, underscores and blanks: "Plot ID", "plot_id".
bool is_same_name(const std::string& a, const std::string& b);

// The place of the first of the names among a table's columns (is_same_name; a column that is spelt
// as the name is preferred). Throws InputError, which tells the table's columns and adds the
// advice, where it has none of them.
std::size_t column_of(const std::filesystem::path& file, const CsvTable& table,
                      const std::vector<std::string>& names, const std::string& advice = "");

}  // namespace plotscan::estimate
