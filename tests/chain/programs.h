// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::testing {

// Words of commands: a farm of four small plots, as farmgen takes it, and the suite of such farms.
inline const std::string kFourPlots =
    "'" PLOTSCAN_SOURCE_DIR
    "/worlds/paper_flat.yaml'"
    " --set terrain.side_m=30 --set 'plots.rows=[{plots: 4}]' --set plants.count=40";
inline const std::string kSmokeSuite = "'" PLOTSCAN_SOURCE_DIR "/benchmarks/suites/smoke.yaml'";

// What a command left behind.
struct Finished {
  int exit_code = -1;
  std::string output;  // stdout
  std::string errors;  // stderr
};

// Runs a program of the build ("farmgen generate ...") through the shell, in `folder`.
Finished run(const std::string& command, const std::string& folder);

}  // namespace plotscan::testing
