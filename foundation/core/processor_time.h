// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// Processor seconds (user and system) that this process has used so far: all its threads, and the
// child processes that it has waited for.
double processor_time_s();

}  // namespace plotscan
