// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: drill rows that show as plots, and the plots that they make up.

#include <optional>

#include "plots/layout.h"

namespace plotscan::plots {

// Whether the plots are as narrow as rows of plants.
bool has_stripes(const Layout& layout);

// Whether `fine` has the drill rows of `coarse`'s plots: narrow stripes, as many of them in each.
bool are_stripes_of(const Layout& fine, const Layout& coarse);

// Plots of drill rows. The layout's bands end where the outer rows' canopy does; what is sown
// reaches half a row's spacing beyond the outer rows.
struct DrilledLayout {
  Layout layout;     // along c, the plots lie beside each other
  double row_m = 0;  // from drill row to drill row
  double gap_m = 0;  // between the canopies of two of them
  double sown_width_m = 0;
};

// Stripes that lie at one small step in groups of the same number, with wider gaps between the
// groups: each group is a plot. None where all steps are alike.
std::optional<DrilledLayout> plots_of_stripes(const Layout& stripes);

}  // namespace plotscan::plots
