// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace plotscan::plots {

// What the user knows of the field; the search takes all of it as true. Rows follow each other
// along the plots' length, columns along their width.
struct Hints {
  std::optional<double> heading_rad = std::nullopt;  // of the plots' length axis
  std::optional<double> width_m = std::nullopt;      // of a plot
  std::optional<double> length_m = std::nullopt;     // of a plot
  std::optional<int> rows = std::nullopt;
  std::optional<int> columns = std::nullopt;
  std::optional<int> plots = std::nullopt;  // in all

  bool tell_layout() const { return width_m || length_m || rows || columns || plots; }
  // A plot's, or of how many plots the field's are made.
  bool tell_sides() const { return width_m || length_m || (rows && columns); }
};

}  // namespace plotscan::plots
