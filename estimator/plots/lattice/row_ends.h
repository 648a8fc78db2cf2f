// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <utility>

namespace plotscan::plots {

// By row: the first and the last column in which it has a plot.
template <class Places>
std::map<int, std::pair<int, int>> row_ends(const Places& places) {
  std::map<int, std::pair<int, int>> ends;
  for (const auto& place : places) {
    auto& [first, last] = ends.try_emplace(place.row, place.column, place.column).first->second;
    first = std::min(first, place.column);
    last = std::max(last, place.column);
  }
  return ends;
}

}  // namespace plotscan::plots
