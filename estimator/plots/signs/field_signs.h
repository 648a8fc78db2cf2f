// SPDX-License-Identifier: Apache-2.0
#pragma once

// Whether what lies on a lattice is a field of plots, and the rows that the plots are sown in.

#include <optional>
#include <string>

#include "plots/lattice/lattice.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// Share of the raster's canopy that lies in the plots.
double held_share(const Lattice& lattice);

// `lattice` is on a raster of the field's canopy.
FieldSigns signs_of(const Lattice& lattice, const FieldCanopy& field, double noise_m,
                    double evidence);

// Why these are no plots; "" where they are.
std::string no_plots_because(const FieldSigns& signs);

// The same of plots that are said to have no gaps: they leave next to nothing beside them. Along
// their other side they may have some; `in_gaps` is the share of the canopy that hangs into those.
std::string no_touching_plots_because(FieldSigns signs, double in_gaps);

// Whether these may be plots of a trial beside others, whose canopy they do not hold and which may
// stand in their gaps: whether nothing else speaks against them.
bool may_be_beside_others(FieldSigns signs);

// The rows that follow each other along r in every plot, where the mean canopy of all plots shows
// them; none where an even canopy explains it nearly as well.
std::optional<SownRows> sown_rows_along(const Lattice& lattice);

// 0 to 1: how clearly the field is one of plots.
double field_confidence(const FieldSigns& signs);
// The same of plots of a trial beside others.
double confidence_beside_others(FieldSigns signs);

}  // namespace plotscan::plots
