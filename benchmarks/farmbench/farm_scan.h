// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "farm/farm.h"
#include "farmbench/suite.h"
#include "lidar/fly.h"
#include "scan/point.h"
#include "score/score.h"

namespace plotscan::farmbench {

// One farm of a suite, its seed that of farm and flight, and the folder that it is made in.
struct FarmPlace {
  const SuiteCase& suite_case;
  std::uint64_t seed = 1;
  std::filesystem::path folder;  // existing
  int threads = 1;
};

// Generates the farm and writes it to folder/farm, with its canopies. Throws InputError when it
// cannot be made.
farm::Farm make_farm(const FarmPlace& place);

// The plots of the farm in folder/farm; where a part is surveyed, those outside it are not scored.
// For a case without plots these are the things in the farm's boxes. Throws InputError when no plot
// is scored.
std::vector<score::TruePlot> standing_plots(const FarmPlace& place);

// Hands on to `sink` the points that lie in the area; their positions are relative to origin_m.
scan::PointSink only_inside(const cloud::Area& area, const Eigen::Vector3d& origin_m,
                            const scan::PointSink& sink);

// A farm's scan, and the cloud of it that methods get.
struct ScannedFarm {
  lidar::FlySummary flown;
  std::filesystem::path cloud;
};

// Flies the farm; the scan lies in folder/scan. Throws InputError when it cannot be flown.
ScannedFarm scan_farm(const FarmPlace& place, const farm::Farm& farm,
                      const ProgressReport& progress);

}  // namespace plotscan::farmbench
