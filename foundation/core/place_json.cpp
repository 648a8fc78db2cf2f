// SPDX-License-Identifier: Apache-2.0
#include "core/place_json.h"

#include "core/angle.h"

namespace plotscan {

nlohmann::json anchor_json(const Anchor& anchor) {
  return {{"latitude_deg", anchor.latitude_deg},
          {"longitude_deg", anchor.longitude_deg},
          {"altitude_m", anchor.altitude_m}};
}

Anchor anchor_from(const nlohmann::json& document) {
  return {.latitude_deg = document.at("latitude_deg"),
          .longitude_deg = document.at("longitude_deg"),
          .altitude_m = document.at("altitude_m")};
}

nlohmann::json box_json(const PlotBox& box) {
  return {{"center_x_m", box.center.x()},
          {"center_y_m", box.center.y()},
          {"width_m", box.width_m},
          {"length_m", box.length_m},
          {"heading_deg", box.heading_rad / kDegrees}};
}

PlotBox box_from(const nlohmann::json& document) {
  return {
      .center = {document.at("center_x_m").get<double>(), document.at("center_y_m").get<double>()},
      .width_m = document.at("width_m"),
      .length_m = document.at("length_m"),
      .heading_rad = document.at("heading_deg").get<double>() * kDegrees};
}

}  // namespace plotscan
