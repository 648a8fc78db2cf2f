// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/progress.h"
#include "farmbench/blind_files.h"
#include "farmbench/suite_choice.h"

namespace plotscan::farmbench {

struct ExportOptions {
  SuiteChoice suite;
  std::filesystem::path output;
  bool replace = false;  // an output folder that exists
  BlindParts parts = {};
  int threads = 1;
};

struct ExportSummary {
  std::size_t fields = 0;
  std::uint64_t points = 0;  // of all clouds
};

// Makes and flies every farm of the suite and writes for each a folder, named by its code
// (suite_choice.h), with the entrants' files, then task.json, TASK.md and manifest.json
// (docs/submissions.md). Fields are made in the order of their codes and all files have the same
// time, so that neither reveals the case of a field. The same suite, options and secret give the
// same bytes for any number of threads. Throws InputError on a bad suite, secret or format, on a
// farm that cannot be made, and on an output folder as OutputFolder does; nothing is left then.
ExportSummary export_suite(const ExportOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::farmbench
