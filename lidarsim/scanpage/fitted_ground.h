// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "ground/surface.h"
#include "report/shown_cloud.h"
#include "report/shown_field.h"

namespace plotscan::scanpage {

// The ground's grid as a page shows it, moved by `move_m` into the cloud's frame.
report::ShownGrid shown_grid(const ground::Surface& surface, const Eigen::Vector3d& move_m);

// The ground under a cloud's shown points; nothing where they show none.
std::optional<report::ShownGrid> fitted_ground(const report::ShownCloud& cloud, int threads);

}  // namespace plotscan::scanpage
