// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "report/shown_cloud.h"
#include "report/shown_field.h"

namespace plotscan::scanpage {

// Fits the ground under a cloud's shown points; nothing if they show no ground.
std::optional<report::ShownGrid> fitted_ground(const report::ShownCloud& cloud, int threads);

}  // namespace plotscan::scanpage
