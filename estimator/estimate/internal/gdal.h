// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <cpl_string.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

// A function of GDAL's C interface: GDAL(GDALOpenEx)(...). GDAL is loaded with the first map that
// needs it: with the hundred libraries that it needs itself, every command would begin a tenth of a
// second later.
#define GDAL(function) \
  reinterpret_cast<decltype(&(function))>(plotscan::estimate::gdal_function(#function))

namespace plotscan::estimate {

// Why GDAL cannot be loaded here; "" where it can.
std::string gdal_missing();

// The function of this name. Only where GDAL can be loaded.
void* gdal_function(const char* name);

// Keeps GDAL from printing its errors on stderr while this object lives.
class QuietGdal {
 public:
  QuietGdal() { GDAL(CPLPushErrorHandler)(GDAL(CPLQuietErrorHandler)); }
  ~QuietGdal() { GDAL(CPLPopErrorHandler)(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

}  // namespace plotscan::estimate
