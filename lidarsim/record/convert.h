// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"
#include "record/formats.h"
#include "record/open_source.h"

namespace plotscan::record {

struct ConvertOptions {
  std::optional<FlightOptions> flight = {};  // for a source that is no scan folder
  std::string topic = {};  // of the clouds in a bag or MCAP file, where there are several
  WriteOptions write = {};
  bool replace = false;  // an existing file
};

struct ConvertSummary {
  std::uint64_t points = 0;  // written
  std::uint64_t poses = 0;   // written, where a trajectory is
};

// Converts `in`, a scan folder, a cloud, a recording or a trajectory, to the file `out`, whose
// format its extension says (docs/formats.md). Points stream: memory does not grow with them, but
// for compressed PCD. `out` appears whole or not at all. Throws InputError on broken input, an
// extension that no format has, a file that exists, an `out` that is `in` or lies in it, and where
// `out` needs what `in` does not say.
ConvertSummary convert(const std::filesystem::path& in, const std::filesystem::path& out,
                       const ConvertOptions& options, const ProgressReport& progress = {});

// The same where `out` may lie in the scan folder `in`: for who writes that folder.
ConvertSummary convert_within(const std::filesystem::path& in, const std::filesystem::path& out,
                              const ConvertOptions& options, const ProgressReport& progress = {});

// Throws InputError where the points of an open source cannot be written to a file of `out`'s name:
// an extension that no format has, options of another format, no flight where one is needed.
void require_writable(const Source& source, const std::filesystem::path& out,
                      const WriteOptions& options);

// The second half of convert, after open_source and require_writable: the points of an open source
// to a file of `out`'s extension, which may not appear whole.
ConvertSummary write_points(const Source& source, const std::filesystem::path& out,
                            const WriteOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::record
