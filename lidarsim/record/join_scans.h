// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"

namespace plotscan::record {

struct JoinOptions {
  std::vector<std::string> formats = {};  // further files, named as in finish_scan
  bool replace = false;                   // replaces an existing scan
};

struct JoinSummary {
  std::size_t parts = 0;
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
};

// Joins the scan folders of all parts of one flight (lidarsim fly --part), given in any order, into
// the folder that the whole flight would have written, byte for byte. Memory does not grow with the
// points. Throws InputError on a folder that is no part or was changed, on parts of different
// flights, on a part that is missing or given twice, and as finish_scan and OutputFolder do.
JoinSummary join_scans(const std::vector<std::filesystem::path>& parts,
                       const std::filesystem::path& scan, const JoinOptions& options,
                       const ProgressReport& progress = {});

}  // namespace plotscan::record
