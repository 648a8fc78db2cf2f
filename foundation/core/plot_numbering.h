// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan {

// How plots are numbered, row after row.
enum class PlotNumbering {
  rows,        // every row from its first column
  serpentine,  // every other row from its last column, as one walks
};

// The column at a place in a row's numbering; also the place of a column. All from 0.
inline std::uint32_t column_at(PlotNumbering numbering, std::size_t row, std::uint32_t place,
                               std::uint32_t columns) {
  const bool backward = numbering == PlotNumbering::serpentine && row % 2 == 1;
  return backward ? columns - 1 - place : place;
}

}  // namespace plotscan
