// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// From this call on, SIGINT and SIGTERM stop all threads but one, remove what TemporaryPaths name,
// and end the process with exit code 128 + signal. Call it before other threads start.
void remove_unfinished_work_on_interrupt();

}  // namespace plotscan
