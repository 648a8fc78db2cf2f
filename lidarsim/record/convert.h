// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "record/formats.h"
#include "record/open_source.h"

namespace plotscan::record {

struct ConvertOptions {
  std::optional<FlightOptions> flight = {};  // only for a source that is no scan folder
  std::string topic = {};  // the topic of the clouds in a bag or MCAP file, if it has several
  WriteOptions write = {};
  bool replace = false;  // replaces an existing file
};

struct ConvertSummary {
  std::uint64_t points = 0;  // written
  std::uint64_t poses = 0;   // poses written, if `out` is a trajectory
  // Points left out: not finite, or no pose or transform covers their time.
  std::uint64_t without_place = 0;
  std::vector<std::string> notes = {};  // what the user should know of `in`
};

// Converts `in` (a scan folder, cloud, recording or trajectory) to the file `out`, in the format of
// its extension (docs/formats.md). Points are streamed: memory does not grow with them, except for
// compressed PCD. `out` appears whole or not at all. Throws InputError on broken input, an unknown
// extension, a file that exists (unless `replace` is set), an `out` that is `in` or lies in it, and
// when `out` needs what `in` does not state.
ConvertSummary convert(const std::filesystem::path& in, const std::filesystem::path& out,
                       const ConvertOptions& options, const ProgressReport& progress = {});

// The same, but `out` may lie in the scan folder `in`: for code that writes that folder.
ConvertSummary convert_within(const std::filesystem::path& in, const std::filesystem::path& out,
                              const ConvertOptions& options, const ProgressReport& progress = {});

// Throws InputError when the points of an open source cannot be written to a file of `out`'s name:
// an unknown extension, options of another format, or a flight that is needed and missing.
void require_writable(const Source& source, const std::filesystem::path& out,
                      const WriteOptions& options);

// The second half of convert, after open_source and require_writable: writes the points of an open
// source to `out`, in the format of its extension. On failure, `out` may be left incomplete.
ConvertSummary write_points(const Source& source, const std::filesystem::path& out,
                            const WriteOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::record
