// SPDX-License-Identifier: Apache-2.0
#pragma once

// Only built where LASzip is (PLOTSCAN_HAVE_LASZIP).

#include <filesystem>

#include "core/temporary_path.h"
#include "scan/las_writer.h"

namespace plotscan::scan {

// Streams points to LAZ: they are written as by LasWriter to a file beside `path`, which close()
// packs with LASzip. Throws as LasWriter does, and InputError where LASzip fails.
class LazWriter : public PointWriter {
 public:
  LazWriter(const std::filesystem::path& path, LasOptions options);

  void write(std::span<const LabelledPoint> points) override { las_.write(points); }
  void close() override;

 private:
  std::filesystem::path path_;
  TemporaryPath unpacked_;
  LasWriter las_;
};

}  // namespace plotscan::scan
