// SPDX-License-Identifier: Apache-2.0
#include "say_estimate.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "cloud/field_density.h"
#include "cloud/point_account.h"
#include <fmt/core.h>

#include "core/geodesy.h"
#include "core/text.h"

namespace plotscan {
namespace {

void say_votes(const Program& program, const nlohmann::json& diagnostics) {
  const auto& plot = diagnostics["plot"];
  const auto& votes = diagnostics["votes"];
  program.say(fmt::format("plot size  {:.2f} x {:.2f} m, heading {:.1f} deg",
                          plot["width_m"].get<double>(), plot["length_m"].get<double>(),
                          plot["heading_deg"].get<double>()));
  program.say(fmt::format("votes      of {} clusters: width {}, length {}, heading {}",
                          votes["clusters"].get<std::size_t>(), votes["width"].get<std::size_t>(),
                          votes["length"].get<std::size_t>(), votes["heading"].get<std::size_t>()));
  const auto& grid = diagnostics["grid"];
  std::string pitch;
  if (grid.contains("column_step_m"))
    pitch += fmt::format(", {:.2f} m along the width", grid["column_step_m"].get<double>());
  if (grid.contains("row_step_m"))
    pitch += fmt::format(", {:.2f} m along the length", grid["row_step_m"].get<double>());
  program.say(fmt::format("grid       {} clusters agree to {:.2f} m rms{}",
                          grid["agreeing_clusters"].get<std::size_t>(), grid["rms_m"].get<double>(),
                          pitch));
}

void say_field(const Program& program, const nlohmann::json& diagnostics) {
  if (diagnostics.contains("nothing")) return;
  const auto& field = diagnostics["field"];
  const auto number = [&](const char* name) { return field.value(name, std::nan("")); };
  program.say(fmt::format("plot size  {:.2f} x {:.2f} m, heading {:.2f} deg", number("width_m"),
                          number("length_m"), number("heading_deg")));
  program.say(
      fmt::format("lattice    {:.0f} rows, {:.0f} columns", number("rows"), number("columns")));
}

void say_crop(const Program& program, const nlohmann::json& crops) {
  std::vector<std::string> likely;
  for (const auto& [crop, probability] : crops.items()) {
    constexpr double kLeast = 0.005;
    if (probability.get<double>() >= kLeast)
      likely.push_back(fmt::format("{} {:.0f} %", crop, 100 * probability.get<double>()));
  }
  program.say("crop       " + joined(likely, ", "));
}

// "EPSG:25832 (UTM 32N; ETRS89 is taken for WGS 84, within 2 m)", of a system that is UTM's.
std::string described(const std::string& crs) {
  const UtmSystem system = utm_system(crs).value();
  std::string text =
      crs + fmt::format(" (UTM {}{}", system.zone.number, system.zone.north ? 'N' : 'S');
  if (system.datum != "WGS 84") text += "; " + system.datum + " is taken for WGS 84, within 2 m";
  return text + ")";
}

void say_given(const Program& program, const estimate::Estimate& estimate) {
  if (!estimate.diagnostics.contains("boxes")) return;
  program.say(fmt::format("boxes      {} plots given, {} {} to {}", estimate.plots.size(),
                          estimate.id_property, estimate.plots.front().id.text(),
                          estimate.plots.back().id.text()));
  if (estimate.diagnostics["boxes"]["from_degrees"].get<bool>()) {
    program.say("           longitude and latitude of the map converted to " +
                described(estimate.crs));
  }
}

// Whose names were given by row and column, and found no plot.
void say_named(const Program& program, const estimate::Estimate& estimate) {
  if (!estimate.diagnostics.contains("names")) return;
  const auto& names = estimate.diagnostics["names"];
  const auto& not_found = names["not_found"];
  program.say(fmt::format("names      {} of {} named plots found, {} {} to {}",
                          estimate.plots.size(), names["plots"].get<std::size_t>(),
                          estimate.id_property, estimate.plots.front().id.text(),
                          estimate.plots.back().id.text()));
  if (not_found.empty()) return;
  std::vector<std::string> ids;
  for (const auto& id : not_found) ids.push_back(id.get<std::string>());
  program.say("           not found: " + joined(ids, ", "));
}

void say_how(const Program& program, const nlohmann::json& diagnostics, double unit_m) {
  for (const auto& note : diagnostics.value("notes", nlohmann::json::array()))
    program.say("note       " + note.get<std::string>());
  program.say("points     " + cloud::point_account(diagnostics));
  const auto& area = diagnostics["area_m"];
  const auto side = [&](int i) { return area[i].get<double>() / unit_m; };
  program.say(fmt::format("field      x {:.1f} to {:.1f}, y {:.1f} to {:.1f} ({})", side(0),
                          side(2), side(1), side(3), unit_name(unit_m)));
  if (diagnostics.contains("density_per_m2")) {
    program.say("density    " + cloud::density_text(diagnostics["density_per_m2"].get<double>()) +
                " points/m2 (median)");
  }
  if (diagnostics.contains("ground")) {
    const auto& ground = diagnostics["ground"];
    const double unknown = 100 * ground.value("unknown_share", 0.0);
    program.say(
        fmt::format("ground     seen in {:.0f} % of {:.1f} m cells{}, noise {:.1f} cm",
                    100 * ground["seen_share"].get<double>(), ground["cell_m"].get<double>(),
                    unknown >= 0.5 ? fmt::format(", unknown in {:.0f} % of the grid", unknown) : "",
                    100 * ground["noise_m"].get<double>()));
  }
  if (diagnostics.contains("votes")) say_votes(program, diagnostics);
  if (diagnostics.contains("field")) say_field(program, diagnostics);
  if (diagnostics.contains("crops")) say_crop(program, diagnostics["crops"]);
}

void say_flags(const Program& program, const estimate::Estimate& estimate) {
  constexpr std::size_t kNamed = 5;
  std::map<std::string, std::vector<std::string>> ids_by_flag;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    for (const std::string& flag : plot.flags) ids_by_flag[flag].push_back(plot.id.text());
  }
  for (const auto& [flag, ids] : ids_by_flag) {
    const std::string named = ids.size() <= kNamed ? " (" + joined(ids, ", ") + ")" : "";
    program.say(fmt::format("flagged    {} of {} plots: {}{}", ids.size(), estimate.plots.size(),
                            flag, named));
  }
}

void say_heights(const Program& program, const nlohmann::json& summary) {
  for (const auto& [name, height] : summary.items()) {
    program.say(fmt::format("{:10} median {:.3f} m, {:.3f} to {:.3f} m, {} plots", name,
                            height["median_m"].get<double>(), height["min_m"].get<double>(),
                            height["max_m"].get<double>(), height["plots"].get<std::size_t>()));
  }
}

}  // namespace

void say_estimate(const Program& program, const estimate::Estimate& estimate,
                  const nlohmann::json& summary) {
  say_how(program, estimate.diagnostics, estimate.units ? estimate.units->horizontal_m : 1);
  say_given(program, estimate);
  say_named(program, estimate);
  say_heights(program, summary);
  say_flags(program, estimate);
}

}  // namespace plotscan
