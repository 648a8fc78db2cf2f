// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/esri_wkt.h"

#ifdef PLOTSCAN_HAVE_GDAL
#include <cmath>
#include <memory>

#include "estimate/internal/gdal.h"
#endif

namespace plotscan::estimate {

#ifdef PLOTSCAN_HAVE_GDAL
namespace {

struct DestroySystem {
  void operator()(OGRSpatialReferenceH system) const { GDAL(OSRDestroySpatialReference)(system); }
};
using System = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroySystem>;

// To six digits, as codes and files round feet.
bool counts_in(OGRSpatialReferenceH system, double unit_m) {
  return std::abs(GDAL(OSRGetLinearUnits)(system, nullptr) / unit_m - 1) < 1e-6;
}

}  // namespace

std::string esri_wkt(const std::string& crs, double unit_m) {
  if (crs.empty() || !gdal_missing().empty()) return "";
  const QuietGdal quiet;
  const System system(GDAL(OSRNewSpatialReference)(nullptr));
  const bool known = GDAL(OSRSetFromUserInput)(system.get(), crs.c_str()) == OGRERR_NONE &&
                     GDAL(OSRIsProjected)(system.get()) != 0;
  if (!known || !counts_in(system.get(), unit_m)) return "";
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  char* text = nullptr;
  const bool written = GDAL(OSRExportToWktEx)(system.get(), &text, options) == OGRERR_NONE;
  const std::string wkt = written && text != nullptr ? text : "";
  GDAL(VSIFree)(text);
  return wkt;
}
#else
std::string esri_wkt(const std::string&, double) { return ""; }
#endif

}  // namespace plotscan::estimate
