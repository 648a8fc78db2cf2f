// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/table_columns.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace plotscan::estimate {
namespace {

std::string plain(const std::string& name) {
  std::string letters = lower_case(name);
  std::erase_if(letters, [](char c) { return c == '_' || c == ' '; });
  return letters;
}

}  // namespace

bool is_same_name(const std::string& a, const std::string& b) { return plain(a) == plain(b); }

std::size_t column_of(const std::filesystem::path& file, const CsvTable& table,
                      const std::vector<std::string>& names, const std::string& advice) {
  for (const std::string& name : names) {
    auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end())
      found = std::ranges::find_if(
          table.columns, [&](const std::string& column) { return is_same_name(column, name); });
    if (found != table.columns.end())
      return static_cast<std::size_t>(found - table.columns.begin());
  }
  throw InputError(file, "has no column {}{}; its columns are {}", joined(names, " or "), advice,
                   joined(table.columns, ", "));
}

}  // namespace plotscan::estimate
