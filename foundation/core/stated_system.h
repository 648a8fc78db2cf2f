// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace plotscan {

// What a map of plots (GeoJSON) says of its coordinates.
struct StatedSystem {
  std::string crs = {};     // "EPSG:<code>" or another name; "" for none, and for a local system
  bool in_degrees = false;  // longitude and latitude, by its member crs or coordinate_system
};

// How "coordinate_system" begins in a file of write_plot_features_wgs84.
inline constexpr std::string_view kDegreesStated = "WGS84 longitude, latitude";

StatedSystem stated_system(const nlohmann::json& map);

// The same of a file. Throws InputError as read_map_document does.
StatedSystem stated_system(const std::filesystem::path& map);

// A map's parsed document. Throws InputError on a missing file, one of more than 64 MB, and broken
// JSON.
nlohmann::json read_map_document(const std::filesystem::path& map);

// Throws the InputError of a document that is no map of plots, for the reason that `error` gives.
[[noreturn]] void fail_no_map(const std::filesystem::path& map,
                              const nlohmann::json::exception& error);

}  // namespace plotscan
