// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace plotscan {

// Called by long work with the share done, in [0, 1], from one thread at a time, which need not be
// the caller's. What it throws ends the work, leaves nothing half-written, and reaches the caller.
// May be empty.
using Progress = std::function<void(double share_done)>;

}  // namespace plotscan
