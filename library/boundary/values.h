// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plotscan/plots.h"

#include "core/plot_box.h"

namespace plotscan::boundary {

// The one for the other; the heading is brought into [0, 180) degrees on its way out.
PlotBox inner(const Box& box);
Box outer(const PlotBox& box);
PlotBoxError inner(const BoxError& error);
BoxError outer(const PlotBoxError& error);

// A number of threads as the rooms take it: of 0, the processors.
int threads_of(int threads);

}  // namespace plotscan::boundary
