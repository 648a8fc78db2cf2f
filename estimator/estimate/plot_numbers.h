// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/plot_numbering.h"
#include "estimate/estimate.h"
#include "estimate/plot_map.h"

namespace plotscan::estimate {

// The corner of the field in which row 1 and column 1 meet. In a turned field it is the corner that
// lies farthest in that direction.
enum class Corner { sw, se, nw, ne };

// Their names as users write them, in this order; of numberings too: "zigzag" is
// PlotNumbering::rows.
const std::vector<std::string>& corner_names();
const std::vector<std::string>& numbering_names();
// The corner, the numbering of that name. Throw InputError, which lists the names, on another.
Corner corner_named(const std::string& name);
PlotNumbering numbering_named(const std::string& name);

// How to number the plots that were found; without any option they keep the numbers they have.
struct NumberingOptions {
  std::optional<std::uint32_t> first_number = {};   // else 1
  std::optional<PlotNumbering> numbering = {};      // else rows
  std::optional<Corner> first_corner = {};          // else sw
  std::optional<std::filesystem::path> names = {};  // a table of ids by place: read_named_places

  bool any() const { return first_number || numbering || first_corner || names; }
};

// Counts rows (along the plots' length) and columns (along their width) from the first corner, and
// numbers the plots along the rows. Every place of the grid has its number, a place without a plot
// too: where a plot failed the others keep theirs. Several trials are numbered one after the other.
// Plots come in the order of their numbers. Throws InputError where the method gave no rows and
// columns.
void number_plots(const NumberingOptions& options, Estimate& estimate);

// Counts rows and columns alike, and gives every plot the id and attributes of its place.
// diagnostics.names says which of the places have no plot. Throws InputError where several trials
// were found, where the named field has not as many rows and columns as the one that was found, and
// where a plot lies in a place without a name.
void name_plots(const NumberingOptions& options, const NamedPlaces& places, Estimate& estimate);

}  // namespace plotscan::estimate
