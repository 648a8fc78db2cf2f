// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace plotscan::farmbench {

// What a sequence holds. Points by class: unlabelled, ground, crop, weed, other.
struct ScanCounts {
  std::size_t scans = 0;
  std::uint64_t points = 0;
  std::array<std::uint64_t, 5> by_class{};
};

// Cuts a scan folder's points into the sensor's turns and writes them into an existing folder as
// SemanticKITTI lays out a sequence (Behley et al., ICCV 2019; docs/dataset.md): velodyne/N.bin,
// labels/N.label, plants/N.plant, calib.txt, poses.txt, times.txt. Points are in the lidar frame of
// the instant at which their turn began; poses are the reported ones of the lidar in the world,
// which place the points where the cloud has them. A turn without a point has no scan. Throws
// InputError on a plot's id beyond 65535.
ScanCounts write_labelled_scans(const std::filesystem::path& scan,
                                const std::filesystem::path& sequence);

}  // namespace plotscan::farmbench
