// SPDX-License-Identifier: Apache-2.0
#pragma once

// Layouts beside what the user tells of them.

#include <string>

#include "core/trial_layout.h"
#include "plots/hints.h"
#include "plots/layout/layout.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// "3 rows of 10 plots of 1.48 x 3.99 m".
std::string text_of(const Layout& layout);

// Whether what the canopy shows is what the user tells. Leaves make plots look up to a fifth wider.
bool is_as_told(const Layout& layout, const Hints& hints);
// The same of plots that were found.
bool is_as_told(const TrialLayout& layout, const Hints& hints);

// Plots that were found without the sides told, with these.
PlotField with_sides(PlotField field, const Hints& hints);

// Why these are not the plots that the user told; "" where they are. A box may be told larger than
// the steps, a number may not make it so.
std::string not_told_because(const TrialLayout& layout, const FieldSigns& signs,
                             const Hints& hints);

}  // namespace plotscan::plots
