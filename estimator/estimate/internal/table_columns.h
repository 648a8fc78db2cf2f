// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/csv.h"

namespace plotscan::estimate {

// The place of the first of the names among a table's columns. Throws InputError, which tells the
// table's columns and adds the advice, where it has none of them.
std::size_t column_of(const std::filesystem::path& file, const CsvTable& table,
                      const std::vector<std::string>& names, const std::string& advice = "");

}  // namespace plotscan::estimate
