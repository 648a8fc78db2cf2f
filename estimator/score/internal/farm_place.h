// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/geodesy.h"
#include "core/plot_box.h"

namespace plotscan::score {

// Where on Earth a farm's world frame lies, as its manifest says; absent where it does not, and for
// a folder without a manifest. Throws InputError on a broken one.
std::optional<Anchor> anchor_of(const std::filesystem::path& farm);

// "EPSG:<code>" of WGS 84 / UTM in the anchor's zone.
std::string utm_crs_of(const Anchor& anchor);

// A box of the world frame in the metres of a UTM zone, as `lidarsim convert --crs utm` brings
// points there: its sides and its heading are those of the zone's grid.
PlotBox in_utm(const PlotBox& box, const Anchor& anchor, const UtmZone& zone);

}  // namespace plotscan::score
