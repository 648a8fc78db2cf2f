// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "record/recording/format.h"

namespace plotscan::record {

// A LAS writer that also writes what LAS can hold of the source's flight: GPS time, sensor, scan
// angles and, with options.crs "utm", coordinates in the farm's UTM zone. Throws InputError when
// these are asked for and the source has no place on Earth.
std::unique_ptr<scan::PointWriter> create_las(const std::filesystem::path& file,
                                              const Source& source, const WriteOptions& options);
#ifdef PLOTSCAN_HAVE_LASZIP
// The same for LAZ, which is packed by LASzip.
std::unique_ptr<scan::PointWriter> create_laz(const std::filesystem::path& file,
                                              const Source& source, const WriteOptions& options);
#endif

}  // namespace plotscan::record
