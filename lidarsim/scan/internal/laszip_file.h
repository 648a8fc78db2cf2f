// SPDX-License-Identifier: Apache-2.0
#pragma once

// Only built where LASzip is.

#include <filesystem>

#include <laszip/laszip_api.h>

namespace plotscan::scan {

// A LASzip reader or writer, closed with this object. Throws InputError naming the file, with
// LASzip's own words, where LASzip fails.
class LaszipFile {
 public:
  explicit LaszipFile(std::filesystem::path file);
  ~LaszipFile();
  LaszipFile(const LaszipFile&) = delete;
  LaszipFile& operator=(const LaszipFile&) = delete;

  laszip_POINTER get() const { return laszip_; }
  // What a function of LASzip returned: 0 is success.
  void require(laszip_I32 returned) const;
  laszip_header_struct& header() const;
  laszip_point_struct& point() const;

 private:
  std::filesystem::path file_;
  laszip_POINTER laszip_ = nullptr;
};

}  // namespace plotscan::scan
