// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/cloud_files.h"
#include "core/progress.h"
#include "report/page.h"

namespace plotscan::fieldpage {

struct PageOptions {
  std::filesystem::path estimate;  // an estimate folder, or a GeoJSON file of plots with heights
  std::filesystem::path html;
  // A farm folder, a GeoJSON file of plots with heights, or a table of measured ones.
  std::optional<std::filesystem::path> truth = {};
  std::optional<std::string> id = {};    // column of that table with the plots' ids
  std::optional<CloudFiles> cloud = {};  // that was measured; files as cloud_files_of takes them
  std::size_t points = 3'000'000;        // at most, 1 to report::kMostPoints
  bool replace = false;                  // an existing page
};

// Writes one HTML page of an estimate: plots, heights, ground and, where they are given, the
// cloud's positions and the truth (docs/report.md). Throws InputError on bad input and a page that
// exists; nothing is left behind then.
report::PageSummary write_estimate_page(const PageOptions& options,
                                        const ProgressReport& progress = {});

}  // namespace plotscan::fieldpage
