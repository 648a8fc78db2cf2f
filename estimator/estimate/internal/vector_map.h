// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace plotscan::estimate {

// Whether a map of plots is a GeoPackage or a shapefile, by its name: .gpkg, .shp.
bool is_vector_map(const std::filesystem::path& file);

// Its layer of polygons as a GeoJSON FeatureCollection: coordinates as they are in the file, x or
// longitude first, the coordinate system in a member crs where it has an EPSG code or a name, every
// attribute as a property, numbers and texts as they are, dates as texts, and the primary key of a
// GeoPackage by its column's name. Throws InputError on a file that GDAL cannot read, one without
// polygons or with several layers of them, on longitudes and latitudes of a datum that is not known
// (is_geographic), on texts that are no UTF-8, and in a build without GDAL.
nlohmann::json read_vector_map(const std::filesystem::path& file);

}  // namespace plotscan::estimate
