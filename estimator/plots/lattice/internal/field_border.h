// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where a field's lattice ends.

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Removes small groups far from the others, if there is one that tells the pitch: they hold
// something else, ridges, bushes or cars.
void leave_out_strays(Lattice& lattice);

// Removes the rows and columns at the field's border that were cut out of a crop without plots. Of
// fields in common rows and columns only.
void leave_out_crop(Lattice& lattice);

// Removes the plots at the field's border that hedges, vehicles or weeds were taken for.
void leave_out_beside(Lattice& lattice);

// Adds the rows and columns beyond the outer ones that hold plots too: leaves that close the gap to
// them may have hidden where they begin. Of fields in common rows and columns only.
void go_on_beyond(Lattice& lattice);

}  // namespace plotscan::plots
