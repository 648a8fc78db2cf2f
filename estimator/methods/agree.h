// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "estimate/estimate.h"
#include "estimate/measured_heights.h"

namespace plotscan::methods {

// Scales the estimate's heights so that they agree with those measured by hand in some of its plots
// (heights::agreement), trial by trial where enough of its plots were measured; the intervals
// become those of what is left. Heights that were not measured stay. diagnostics.measured says by
// how much. Throws InputError where the table names a height that the estimate has not, or has
// without a standard error, on one that can't be the plot's, where the estimate lacks all of its
// plots, and where no trial has heights::kLeastMeasured of them.
void agree_with(const estimate::MeasuredHeights& measured, estimate::Estimate& estimate);

}  // namespace plotscan::methods
