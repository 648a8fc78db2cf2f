// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// Seconds of processors that this process has used so far, user and system: on all its threads, and
// in the children that it has waited for.
double processor_time_s();

}  // namespace plotscan
