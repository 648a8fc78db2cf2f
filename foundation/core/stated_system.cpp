// SPDX-License-Identifier: Apache-2.0
#include "core/stated_system.h"

#include "core/error.h"
#include "core/geodesy.h"
#include "core/json_text.h"

namespace plotscan {
namespace {

using nlohmann::json;

// Some hundred thousand plots; parsed, they take about fifteen times as much memory.
constexpr std::uintmax_t kMostBytes = 64'000'000;

// "EPSG:<code>" if the member crs has a code; "" if it names none, or a local one.
std::string stated_crs(const json& map) {
  if (!map.contains("crs") || !map["crs"].is_object()) return "";
  const json properties = map["crs"].value("properties", json::object());
  const std::string name = properties.is_object() ? properties.value("name", "") : "";
  if (name.starts_with("LOCAL_CS") || name.starts_with("ENGCRS")) return "";
  const std::size_t code = name.find_last_of(':');
  const bool is_epsg = name.find("EPSG:") != std::string::npos && code != std::string::npos;
  return is_epsg ? "EPSG:" + name.substr(code + 1) : name;
}

}  // namespace

StatedSystem stated_system(const json& map) {
  StatedSystem stated{.crs = stated_crs(map)};
  if (!stated.crs.empty()) {
    stated.in_degrees = is_geographic(stated.crs) || stated.crs.find("CRS84") != std::string::npos;
  } else if (map.contains("coordinate_system") && map["coordinate_system"].is_string()) {
    stated.in_degrees =
        map["coordinate_system"].get_ref<const std::string&>().starts_with(kDegreesStated);
  }
  return stated;
}

StatedSystem stated_system(const std::filesystem::path& map) {
  try {
    return stated_system(read_map_document(map));
  } catch (const json::exception& error) {
    fail_no_map(map, error);
  }
}

json read_map_document(const std::filesystem::path& map) {
  require_file(map);
  if (std::filesystem::file_size(map) > kMostBytes) {
    throw InputError(map, "has {} bytes; plots are read from up to {}",
                     std::filesystem::file_size(map), kMostBytes);
  }
  try {
    return json::parse(read_json_text(map));
  } catch (const json::exception& error) {
    fail_no_map(map, error);
  }
}

void fail_no_map(const std::filesystem::path& map, const json::exception& error) {
  throw InputError(map, "is no map of plots, a GeoJSON FeatureCollection of polygons: {}",
                   json_reason(error));
}

}  // namespace plotscan
