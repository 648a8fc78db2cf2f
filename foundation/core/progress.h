// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace plotscan {

// Called by long work with the share done, in [0, 1], from one thread at a time. May be empty.
using ProgressReport = std::function<void(double share_done)>;

}  // namespace plotscan
