// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plot_box.h"
#include "plotscan/plots.h"

namespace plotscan::boundary {

// Converts between the two boxes; `outer` brings the heading into [0, 180) degrees.
PlotBox inner(const Box& box);
Box outer(const PlotBox& box);
PlotBoxError inner(const BoxError& error);
BoxError outer(const PlotBoxError& error);

// The number of threads to use: for 0, that of the processors. Throws InputError below 0.
int threads_of(int threads);

}  // namespace plotscan::boundary
