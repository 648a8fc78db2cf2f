// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::methods {

// Whether a flag of a plot (PlotEstimate::flags) is a reason not to trust its height of this name
// ("canopy_p95"). A flag concerns all heights, unless it names the one that it speaks of.
bool concerns(const std::string& flag, const std::string& height);

}  // namespace plotscan::methods
