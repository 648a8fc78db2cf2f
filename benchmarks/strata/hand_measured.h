// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "estimate/estimate.h"
#include "score/score.h"

namespace plotscan::strata {

// Has the estimate agree (methods::agree_with) with what people would measure in so many of the
// plots that were found in each trial, drawn by the field's index: the mean of three of a plot's
// plants (height_hand3_m). These plots are no longer scored. Trials with no more plots stay as they
// are.
void agree_with_hand(int plots, int index, std::vector<score::TruePlot>& truth,
                     estimate::Estimate& estimate);

}  // namespace plotscan::strata
