// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/progress.h"
#include "farmbench/export/export_suite.h"

namespace plotscan::farmbench {

struct DatasetSummary {
  std::size_t farms = 0;
  std::size_t scans = 0;
  std::uint64_t points = 0;
};

// Makes and flies every farm of the suite and writes it as a sequence of labelled scans with its
// plots, boxes and heights, then dataset.json, README.md (the card) and manifest.json
// (docs/dataset.md). `command` makes the same data set again, for its card; options.parts have no
// effect. The same suite and options give the same bytes. Throws InputError as export_suite does,
// on a survey of a part of a field, and on a plot's id beyond 65535.
DatasetSummary export_dataset(const ExportOptions& options, const std::string& command,
                              const ProgressReport& progress = {});

}  // namespace plotscan::farmbench
