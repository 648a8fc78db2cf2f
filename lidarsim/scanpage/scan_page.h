// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "core/progress.h"
#include "record/open_source.h"
#include "report/shown_cloud.h"

namespace plotscan::scanpage {

struct PageOptions {
  std::filesystem::path scan;  // scan folder, cloud or recording
  std::filesystem::path html;
  record::SourceOptions source = {};
  // Whose boxes are shown: a farm folder's true plots, or a map of plots (GeoJSON) in the cloud's
  // frame.
  std::optional<std::filesystem::path> plots = {};
  std::size_t points = 3'000'000;  // at most, 1 to report::kMostPoints
  int threads = 1;
  bool replace = false;  // an existing page
};

struct PageSummary {
  std::uint64_t read = 0;   // points of the scan
  std::uint64_t shown = 0;  // of these
  std::size_t plots = 0;
};

// Writes one HTML page of a scan: its points in three dimensions over the ground that is fitted to
// them, the drone's path, and plots where they are given (docs/report.md). Throws InputError on bad
// input and a page that exists; nothing is left behind then.
PageSummary write_scan_page(const PageOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::scanpage
