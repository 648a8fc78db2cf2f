// SPDX-License-Identifier: Apache-2.0
#include "scan/internal/laszip_file.h"

#include <utility>

#include "core/error.h"

namespace plotscan::scan {

LaszipFile::LaszipFile(std::filesystem::path file) : file_(std::move(file)) {
  check(laszip_create(&laszip_) == 0, "LASzip makes a reader or writer");
}

LaszipFile::~LaszipFile() { laszip_destroy(laszip_); }

void LaszipFile::require(laszip_I32 returned) const {
  if (returned == 0) return;
  laszip_CHAR* error = nullptr;
  laszip_get_error(laszip_, &error);
  throw InputError(file_, "cannot be read or written as LAZ; LASzip says: {}",
                   std::string(error != nullptr ? error : "nothing"));
}

laszip_header_struct& LaszipFile::header() const {
  laszip_header_struct* header = nullptr;
  require(laszip_get_header_pointer(laszip_, &header));
  return *header;
}

laszip_point_struct& LaszipFile::point() const {
  laszip_point_struct* point = nullptr;
  require(laszip_get_point_pointer(laszip_, &point));
  return *point;
}

}  // namespace plotscan::scan
