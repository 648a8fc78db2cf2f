// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "estimate/estimate.h"
#include "plotscan/estimate.h"

namespace plotscan::boundary {

FieldEstimate outer(const estimate::Estimate& estimate);

// The parts of an estimate that scoring uses: its method, and its plots' boxes, heights and flags.
estimate::Estimate inner(const FieldEstimate& estimate);

}  // namespace plotscan::boundary
