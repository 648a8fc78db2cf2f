// SPDX-License-Identifier: Apache-2.0
#include "score/internal/farm_place.h"

#include <cmath>

#include <fmt/core.h>

#include "core/error.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/place_json.h"

namespace plotscan::score {

std::optional<Anchor> anchor_of(const std::filesystem::path& farm) {
  const nlohmann::json::json_pointer place("/results/anchor");
  if (!std::filesystem::exists(farm / "manifest.json")) return std::nullopt;
  const nlohmann::json manifest = read_manifest(farm);
  if (!manifest.contains(place)) return std::nullopt;
  try {
    return anchor_from(manifest[place]);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(farm / "manifest.json", "results.anchor: {}", json_reason(error));
  }
}

std::string utm_crs_of(const Anchor& anchor) {
  const UtmZone zone = utm_zone(anchor);
  return fmt::format("EPSG:{}", (zone.north ? 32600 : 32700) + zone.number);
}

PlotBox in_utm(const PlotBox& box, const Anchor& anchor, const UtmZone& zone) {
  const auto utm = [&](const Eigen::Vector2d& world) -> Eigen::Vector2d {
    return utm_from_geodetic(zone, geodetic_from_world(anchor, {world.x(), world.y(), 0}))
        .head<2>();
  };
  const auto side = [&](const Eigen::Vector2d& half) -> Eigen::Vector2d {
    return utm(box.center + half) - utm(box.center - half);
  };
  const Eigen::Vector2d along = side(box.length_m / 2 * box.length_axis());
  const Eigen::Vector2d across = side(box.width_m / 2 * box.width_axis());
  return {.center = utm(box.center),
          .width_m = across.norm(),
          .length_m = along.norm(),
          .heading_rad = wrap_heading(std::atan2(along.y(), along.x()))};
}

}  // namespace plotscan::score
