// SPDX-License-Identifier: Apache-2.0
#include "core/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace plotscan {
namespace {

// Levenshtein distance: letters inserted, removed or replaced, by the usual table row by row.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t exchanged = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({exchanged, row[k] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(const std::string& given,
                                        const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 100;
  if (given.size() > kLongest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t least = given.size() / 3 + 1;
  for (const std::string& name : names) {
    const std::size_t letters = distance(given, name);
    if (letters >= least) continue;
    least = letters;
    nearest = name;
  }
  return nearest;
}

}  // namespace plotscan
