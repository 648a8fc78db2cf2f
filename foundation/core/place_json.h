// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <nlohmann/json.hpp>

#include "core/geodesy.h"
#include "core/plot_box.h"

// Places as JSON files and tables hold them.
namespace plotscan {

// An object of latitude_deg, longitude_deg, altitude_m.
nlohmann::json anchor_json(const Anchor& anchor);
// Throws nlohmann::json::exception if a member is missing or no number.
Anchor anchor_from(const nlohmann::json& document);

// A box's properties: metres, and degrees of the length axis counter-clockwise from east.
inline constexpr std::array<const char*, 5> kBoxProperties = {"center_x_m", "center_y_m", "width_m",
                                                              "length_m", "heading_deg"};
nlohmann::json box_json(const PlotBox& box);
// Throws as anchor_from does.
PlotBox box_from(const nlohmann::json& document);

}  // namespace plotscan
