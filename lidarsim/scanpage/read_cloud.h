// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/progress.h"
#include "record/open_source.h"
#include "report/shown_cloud.h"

namespace plotscan::scanpage {

// A scan as a page shows it.
struct ShownScan {
  report::ShownCloud cloud;
  std::vector<Eigen::Vector3d> path = {};  // of the drone, if known; in the cloud's frame
};

struct ReadOptions {
  std::size_t most = 1;                          // most points that are kept
  std::optional<Eigen::AlignedBox2d> area = {};  // else all that there are
  record::SourceOptions source = {};
};

// Reads a scan folder, cloud or recording: a random sample of its points (of those in the area),
// each equally likely, with class, plot, intensity and time if the file has them. Throws InputError
// on broken input.
ShownScan read_shown_scan(const std::filesystem::path& scan, const ReadOptions& options,
                          const ProgressReport& progress = {});

}  // namespace plotscan::scanpage
