// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "programs.h"
#include "temporary_folder.h"

namespace plotscan::testing {

// A farm of 9 plots, as farmgen generate's description and settings.
inline const std::string kSmallFarm =
    std::string("'") + PLOTSCAN_SOURCE_DIR "/worlds/paper_flat.yaml'" +
    " --set terrain.side_m=30 --set plots.rows.0.plots=3 --set plots.rows.1.plots=3" +
    " --set plots.rows.2.plots=3 --set plants.count=40";

// Commands in a folder of their own.
class CommandsInAFolder : public ::testing::Test {
 protected:
  Finished succeed(const std::string& command) {
    Finished finished = run(command, folder_.path().string());
    EXPECT_EQ(finished.exit_code, 0) << command << '\n' << finished.output << finished.errors;
    return finished;
  }

  TemporaryFolder folder_;
};

}  // namespace plotscan::testing
