// SPDX-License-Identifier: Apache-2.0
// What the methods and their users must not be able to compile: the truth.
#include "farm/farm.h"
#include "methods/run.h"

std::size_t plots_of(const plotscan::farm::Farm& farm) { return farm.plots.size(); }
