// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "core/progress.h"
#include "record/open_source.h"
#include "report/page.h"

namespace plotscan::scanpage {

struct PageOptions {
  std::filesystem::path scan;  // scan folder, cloud or recording
  std::filesystem::path html;
  record::SourceOptions source = {};
  // The plots whose boxes are shown: a farm folder's true plots, or a map of plots (GeoJSON) in the
  // cloud's frame.
  std::optional<std::filesystem::path> plots = {};
  std::size_t points = 3'000'000;  // most points shown, 1 to report::kMostPoints
  int threads = 1;
  bool replace = false;  // replaces an existing page
};

// Writes one HTML page of a scan: its points in three dimensions over the ground that is fitted to
// them, the drone's path, and plots if they are given (docs/report.md). Throws InputError on bad
// input and on a page that exists (unless `replace` is set), and then leaves nothing behind.
report::PageSummary write_scan_page(const PageOptions& options,
                                    const ProgressReport& progress = {});

}  // namespace plotscan::scanpage
