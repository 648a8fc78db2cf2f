// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "record/open_source.h"
#include "report/shown_cloud.h"

namespace plotscan::scanpage {

// A scan as a page shows it.
struct ShownScan {
  report::ShownCloud cloud;
  std::vector<Eigen::Vector3d> path = {};  // of the drone where it is known, the cloud's frame
};

// Reads a scan folder, cloud or recording: a fair sample of at most `most` points with class, plot,
// intensity and time where the file has them. Throws InputError on broken input.
ShownScan read_shown_scan(const std::filesystem::path& scan, std::size_t most,
                          const record::SourceOptions& source = {},
                          const ProgressReport& progress = {});

}  // namespace plotscan::scanpage
