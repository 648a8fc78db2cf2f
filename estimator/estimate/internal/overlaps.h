// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plot_box.h"
#include "core/plot_id.h"

namespace plotscan::estimate {

// What to tell the user of plots that lie over others, as a border drawn around a trial does: over
// more than half of the smaller one's area. "" where there are none. `ids` are those of the boxes.
std::string overlap_note(const std::vector<PlotBox>& boxes, const std::vector<PlotId>& ids);

}  // namespace plotscan::estimate
