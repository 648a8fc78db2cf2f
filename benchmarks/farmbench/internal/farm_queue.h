// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "core/progress.h"

namespace plotscan::farmbench {

// Calls work(i, its progress) for i in [0, count), up to `jobs` at a time, each on its own thread,
// started in the order of i. `progress` gets the mean of all. After the first exception no further
// work starts; it is thrown when the running work has ended.
void run_queue(std::size_t count, int jobs, const ProgressReport& progress,
               const std::function<void(std::size_t, const ProgressReport&)>& work);

}  // namespace plotscan::farmbench
