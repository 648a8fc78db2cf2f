// SPDX-License-Identifier: Apache-2.0
// The control: the same translation unit without the farm compiles.
#include "methods/run.h"

std::size_t plots_of(const plotscan::estimate::Estimate& estimate) { return estimate.plots.size(); }
