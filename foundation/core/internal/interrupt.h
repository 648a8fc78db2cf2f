// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// From here on SIGINT and SIGTERM stop all threads but one, remove what TemporaryPaths name, and
// end the process with 128 + signal. Call it before other threads are started.
void remove_unfinished_work_on_interrupt();

}  // namespace plotscan
