// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/vector_map.h"

#include <string>

#include "core/error.h"

#ifdef PLOTSCAN_HAVE_GDAL
#include <memory>
#include <vector>

#include <fmt/core.h>
#include <gdal.h>
#include <ogrsf_frmts.h>

#include "core/geodesy.h"
#endif

#include "core/text.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;

bool is_vector_map(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".gpkg" || extension == ".shp";
}

#ifdef PLOTSCAN_HAVE_GDAL
namespace {

using nlohmann::json;

// Keeps GDAL from printing its errors on stderr while this object lives.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

std::unique_ptr<GDALDataset> open_map(const fs::path& file) {
  require_file(file);
  GDALAllRegister();
  std::unique_ptr<GDALDataset> map(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!map) throw InputError(file, std::string("cannot be read: ") + CPLGetLastErrorMsg());
  return map;
}

// A layer of unknown geometry type may hold polygons, too.
bool may_be_polygons(OGRwkbGeometryType type) {
  const OGRwkbGeometryType flat = wkbFlatten(type);
  return flat == wkbPolygon || flat == wkbMultiPolygon || flat == wkbUnknown;
}

OGRLayer& layer_of_plots(const fs::path& file, GDALDataset& map) {
  std::vector<OGRLayer*> layers;
  std::vector<std::string> names;
  for (OGRLayer* layer : map.GetLayers()) {
    if (!may_be_polygons(layer->GetGeomType())) continue;
    layers.push_back(layer);
    names.emplace_back(layer->GetName());
  }
  if (layers.empty()) throw InputError(file, "has no layer of polygons");
  if (layers.size() > 1) {
    throw InputError(
        file, "has several layers of polygons: {}; save that of the plots as a file of its own",
        joined(names, ", "));
  }
  return *layers.front();
}

// The name for a member crs; "" of a local system.
std::string crs_of(const fs::path& file, const OGRSpatialReference* system) {
  if (system == nullptr || system->IsLocal()) return "";
  const char* const node = system->IsGeographic() ? "GEOGCS" : "PROJCS";
  const char* const authority = system->GetAuthorityName(node);
  const char* const code = system->GetAuthorityCode(node);
  const bool has_code = authority != nullptr && code != nullptr && authority == std::string("EPSG");
  const std::string epsg = has_code ? std::string("EPSG:") + code : "";
  const std::string name = system->GetName() == nullptr ? "unnamed" : system->GetName();
  if (system->IsGeographic() && !is_geographic(epsg)) {
    throw InputError(file,
                     "is in longitude and latitude of the system \"{}\"{}, which is not known "
                     "here; save it in the cloud's system",
                     name, has_code ? " (" + epsg + ")" : "");
  }
  return has_code ? std::string("urn:ogc:def:crs:EPSG::") + code : name;
}

json ring_of(const OGRLinearRing& ring) {
  json positions = json::array();
  for (int i = 0; i < ring.getNumPoints(); ++i) positions.push_back({ring.getX(i), ring.getY(i)});
  return positions;
}

json rings_of(const OGRPolygon& polygon) {
  json rings = json::array();
  for (const OGRLinearRing* ring : polygon) rings.push_back(ring_of(*ring));
  return rings;
}

json geometry_of(const OGRGeometry* geometry) {
  if (geometry == nullptr || geometry->IsEmpty()) return nullptr;
  if (wkbFlatten(geometry->getGeometryType()) == wkbPolygon)
    return {{"type", "Polygon"}, {"coordinates", rings_of(*geometry->toPolygon())}};
  if (wkbFlatten(geometry->getGeometryType()) != wkbMultiPolygon)
    return {{"type", geometry->getGeometryName()}};
  json parts = json::array();
  for (const OGRPolygon* polygon : *geometry->toMultiPolygon()) parts.push_back(rings_of(*polygon));
  return {{"type", "MultiPolygon"}, {"coordinates", parts}};
}

std::string date_of(const OGRFeature& feature, int field) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, zone = 0;
  feature.GetFieldAsDateTime(field, &year, &month, &day, &hour, &minute, &second, &zone);
  return fmt::format("{:04}-{:02}-{:02}", year, month, day);
}

std::string field_text(const OGRFeature& feature, int field) {
  std::string text = feature.GetFieldAsString(field);
  if (CPLIsUTF8(text.c_str(), -1) != 0) return text;
  throw InputError(std::string("its attribute \"") + feature.GetFieldDefnRef(field)->GetNameRef() +
                   "\" has letters in another encoding than the file states; save it in UTF-8");
}

json field_value(const OGRFeature& feature, int field) {
  if (!feature.IsFieldSetAndNotNull(field)) return nullptr;
  const OGRFieldDefn& definition = *feature.GetFieldDefnRef(field);
  switch (definition.GetType()) {
    case OFTInteger:
    case OFTInteger64:
      if (definition.GetSubType() == OFSTBoolean) return feature.GetFieldAsInteger(field) != 0;
      return feature.GetFieldAsInteger64(field);
    case OFTReal:
      return feature.GetFieldAsDouble(field);
    case OFTDate:
      return date_of(feature, field);
    default:
      return field_text(feature, field);
  }
}

json feature_of(const OGRFeature& feature, const std::string& key) {
  json properties = json::object();
  if (!key.empty()) properties[key] = feature.GetFID();
  for (int field = 0; field < feature.GetFieldCount(); ++field)
    properties[feature.GetFieldDefnRef(field)->GetNameRef()] = field_value(feature, field);
  return {{"type", "Feature"},
          {"geometry", geometry_of(feature.GetGeometryRef())},
          {"properties", properties}};
}

}  // namespace

json read_vector_map(const fs::path& file) {
  const QuietGdal quiet;
  const std::unique_ptr<GDALDataset> map = open_map(file);
  OGRLayer& layer = layer_of_plots(file, *map);
  json document = {{"type", "FeatureCollection"}, {"features", json::array()}};
  const std::string crs = crs_of(file, layer.GetSpatialRef());
  if (!crs.empty()) document["crs"] = {{"type", "name"}, {"properties", {{"name", crs}}}};
  const std::string key = layer.GetFIDColumn();
  try {
    for (const auto& feature : layer) document["features"].push_back(feature_of(*feature, key));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
  return document;
}
#else
nlohmann::json read_vector_map(const fs::path& file) {
  throw InputError(file,
                   "is a GeoPackage or shapefile, and this build has no GDAL to read it with; "
                   "ogr2ogr -f GeoJSON map.geojson {} makes a map that it reads",
                   file.filename().string());
}
#endif

}  // namespace plotscan::estimate
