// SPDX-License-Identifier: Apache-2.0
// What the methods and their users must not be able to compile: the truth.
#include "methods/run.h"

#include "farm/farm.h"

std::size_t plots_of(const plotscan::farm::Farm& farm) { return farm.plots.size(); }
