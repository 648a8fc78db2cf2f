// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/vector_map.h"

#include <string>

#include "core/error.h"

#ifdef PLOTSCAN_HAVE_GDAL
#include <memory>
#include <vector>

#include <fmt/core.h>

#include "core/geodesy.h"
#include "estimate/internal/gdal.h"
#endif

#include "core/text.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;

bool is_vector_map(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".gpkg" || extension == ".shp";
}

namespace {

[[noreturn]] void fail_without_gdal(const fs::path& file, const std::string& why) {
  throw InputError(file,
                   "is a GeoPackage or shapefile, which cannot be read here: {}; "
                   "ogr2ogr -f GeoJSON map.geojson {} makes a map that can",
                   why, file.filename().string());
}

}  // namespace

#ifdef PLOTSCAN_HAVE_GDAL
namespace {

using nlohmann::json;

struct CloseMap {
  void operator()(GDALDatasetH map) const { GDAL(GDALClose)(map); }
};
struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { GDAL(OGR_F_Destroy)(feature); }
};
using Map = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, CloseMap>;
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, DestroyFeature>;

Map open_map(const fs::path& file) {
  require_file(file);
  GDAL(GDALAllRegister)();
  constexpr unsigned kHow = GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
  Map map(GDAL(GDALOpenEx)(file.c_str(), kHow, nullptr, nullptr, nullptr));
  if (!map) throw InputError(file, "cannot be read: {}", GDAL(CPLGetLastErrorMsg)());
  return map;
}

// A layer of unknown geometry type may hold polygons, too.
bool may_be_polygons(OGRwkbGeometryType type) {
  const OGRwkbGeometryType flat = GDAL(OGR_GT_Flatten)(type);
  return flat == wkbPolygon || flat == wkbMultiPolygon || flat == wkbUnknown;
}

OGRLayerH layer_of_plots(const fs::path& file, GDALDatasetH map) {
  std::vector<OGRLayerH> layers;
  std::vector<std::string> names;
  for (int i = 0; i < GDAL(GDALDatasetGetLayerCount)(map); ++i) {
    const OGRLayerH layer = GDAL(GDALDatasetGetLayer)(map, i);
    if (!may_be_polygons(GDAL(OGR_L_GetGeomType)(layer))) continue;
    layers.push_back(layer);
    names.emplace_back(GDAL(OGR_L_GetName)(layer));
  }
  if (layers.empty()) throw InputError(file, "has no layer of polygons");
  if (layers.size() > 1) {
    throw InputError(
        file, "has several layers of polygons: {}; save that of the plots as a file of its own",
        joined(names, ", "));
  }
  return layers.front();
}

// The name for a member crs; "" of a local system.
std::string crs_of(const fs::path& file, OGRSpatialReferenceH system) {
  if (system == nullptr || GDAL(OSRIsLocal)(system) != 0) return "";
  const bool geographic = GDAL(OSRIsGeographic)(system) != 0;
  const char* const node = geographic ? "GEOGCS" : "PROJCS";
  const char* const authority = GDAL(OSRGetAuthorityName)(system, node);
  const char* const code = GDAL(OSRGetAuthorityCode)(system, node);
  const bool has_code = authority != nullptr && code != nullptr && authority == std::string("EPSG");
  const std::string epsg = has_code ? std::string("EPSG:") + code : "";
  const char* const given = GDAL(OSRGetName)(system);
  const std::string name = given == nullptr ? "unnamed" : given;
  if (geographic && !is_geographic(epsg)) {
    throw InputError(file,
                     "is in longitude and latitude of the system \"{}\"{}, which is not known "
                     "here; save it in the cloud's system",
                     name, has_code ? " (" + epsg + ")" : "");
  }
  return has_code ? std::string("urn:ogc:def:crs:EPSG::") + code : name;
}

json ring_of(OGRGeometryH ring) {
  json positions = json::array();
  for (int i = 0; i < GDAL(OGR_G_GetPointCount)(ring); ++i)
    positions.push_back({GDAL(OGR_G_GetX)(ring, i), GDAL(OGR_G_GetY)(ring, i)});
  return positions;
}

// The list that `part_of` makes of the parts of a geometry.
template <class PartOf>
json parts_of(OGRGeometryH geometry, const PartOf& part_of) {
  json parts = json::array();
  for (int i = 0; i < GDAL(OGR_G_GetGeometryCount)(geometry); ++i)
    parts.push_back(part_of(GDAL(OGR_G_GetGeometryRef)(geometry, i)));
  return parts;
}

json rings_of(OGRGeometryH polygon) { return parts_of(polygon, ring_of); }

json geometry_of(OGRGeometryH geometry) {
  if (geometry == nullptr || GDAL(OGR_G_IsEmpty)(geometry) != 0) return nullptr;
  switch (GDAL(OGR_GT_Flatten)(GDAL(OGR_G_GetGeometryType)(geometry))) {
    case wkbPolygon:
      return {{"type", "Polygon"}, {"coordinates", rings_of(geometry)}};
    case wkbMultiPolygon:
      return {{"type", "MultiPolygon"}, {"coordinates", parts_of(geometry, rings_of)}};
    default:
      return {{"type", GDAL(OGR_G_GetGeometryName)(geometry)}};
  }
}

std::string date_of(OGRFeatureH feature, int field) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, zone = 0;
  GDAL(OGR_F_GetFieldAsDateTime)
  (feature, field, &year, &month, &day, &hour, &minute, &second, &zone);
  return fmt::format("{:04}-{:02}-{:02}", year, month, day);
}

std::string name_of(OGRFeatureH feature, int field) {
  return GDAL(OGR_Fld_GetNameRef)(GDAL(OGR_F_GetFieldDefnRef)(feature, field));
}

std::string field_text(OGRFeatureH feature, int field) {
  std::string text = GDAL(OGR_F_GetFieldAsString)(feature, field);
  if (GDAL(CPLIsUTF8)(text.c_str(), -1) != 0) return text;
  throw InputError("its attribute \"" + name_of(feature, field) +
                   "\" has letters in another encoding than the file states; save it in UTF-8");
}

json field_value(OGRFeatureH feature, int field) {
  if (GDAL(OGR_F_IsFieldSetAndNotNull)(feature, field) == 0) return nullptr;
  const OGRFieldDefnH definition = GDAL(OGR_F_GetFieldDefnRef)(feature, field);
  switch (GDAL(OGR_Fld_GetType)(definition)) {
    case OFTInteger:
    case OFTInteger64:
      if (GDAL(OGR_Fld_GetSubType)(definition) == OFSTBoolean)
        return GDAL(OGR_F_GetFieldAsInteger)(feature, field) != 0;
      return GDAL(OGR_F_GetFieldAsInteger64)(feature, field);
    case OFTReal:
      return GDAL(OGR_F_GetFieldAsDouble)(feature, field);
    case OFTDate:
      return date_of(feature, field);
    default:
      return field_text(feature, field);
  }
}

json feature_of(OGRFeatureH feature, const std::string& key) {
  json properties = json::object();
  if (!key.empty()) properties[key] = GDAL(OGR_F_GetFID)(feature);
  for (int field = 0; field < GDAL(OGR_F_GetFieldCount)(feature); ++field)
    properties[name_of(feature, field)] = field_value(feature, field);
  return {{"type", "Feature"},
          {"geometry", geometry_of(GDAL(OGR_F_GetGeometryRef)(feature))},
          {"properties", properties}};
}

}  // namespace

json read_vector_map(const fs::path& file) {
  if (const std::string missing = gdal_missing(); !missing.empty())
    fail_without_gdal(file, missing);
  const QuietGdal quiet;
  const Map map = open_map(file);
  const OGRLayerH layer = layer_of_plots(file, map.get());
  json document = {{"type", "FeatureCollection"}, {"features", json::array()}};
  const std::string crs = crs_of(file, GDAL(OGR_L_GetSpatialRef)(layer));
  if (!crs.empty()) document["crs"] = {{"type", "name"}, {"properties", {{"name", crs}}}};
  const std::string key = GDAL(OGR_L_GetFIDColumn)(layer);
  try {
    while (const Feature feature{GDAL(OGR_L_GetNextFeature)(layer)})
      document["features"].push_back(feature_of(feature.get(), key));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
  return document;
}
#else
nlohmann::json read_vector_map(const fs::path& file) {
  fail_without_gdal(file, "this build has no GDAL");
}
#endif

}  // namespace plotscan::estimate
