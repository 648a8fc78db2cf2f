// SPDX-License-Identifier: Apache-2.0
#include "say_estimate.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "cloud/field_density.h"
#include "core/contains.h"
#include "core/geodesy.h"
#include "core/text.h"
#include "heights/flags.h"

namespace plotscan {
namespace {

std::string crop_text(const std::map<std::string, double>& crops) {
  std::vector<std::string> likely;
  for (const auto& [crop, probability] : crops) {
    constexpr double kLeast = 0.005;
    if (probability >= kLeast)
      likely.push_back(fmt::format("{} {:.0f} %", crop, 100 * probability));
  }
  return joined(likely, ", ");
}

void say_crops(const Program& program, const std::vector<std::map<std::string, double>>& trials) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::string trial = trials.size() > 1 ? fmt::format("trial {}: ", i + 1) : "";
    program.say("crop       " + trial + crop_text(trials[i]));
  }
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
  const auto& given = estimate.diagnostics.boxes;
  if (!given) return;
  program.say("boxes      {} plots given, {} {} to {}", estimate.plots.size(), estimate.id_property,
              estimate.plots.front().id.text(), estimate.plots.back().id.text());
  if (given->from_degrees) {
    program.say("           longitude and latitude of the map converted to " +
                described(estimate.crs));
  }
}

// Prints the named places (row and column) in which no plot was found.
void say_named(const Program& program, const estimate::Estimate& estimate) {
  const auto& names = estimate.diagnostics.names;
  if (!names) return;
  program.say("names      {} of {} named plots found, {} {} to {}", estimate.plots.size(),
              names->plots, estimate.id_property, estimate.plots.front().id.text(),
              estimate.plots.back().id.text());
  if (names->not_found.empty()) return;
  program.say("           not found: " + joined(names->not_found));
}

// How far the heights were moved to agree with those measured by hand.
void say_measured(const Program& program, const estimate::Estimate& estimate) {
  const auto& measured = estimate.diagnostics.measured;
  if (!measured) return;
  for (const estimate::Agreed& agreed : measured->heights) {
    const std::string trial =
        agreed.trial > 0 ? fmt::format("trial {}: ", agreed.trial) : std::string();
    program.say(
        "measured   {}{} times {:.3f} +- {:.3f}, by {} plots, which scatter by "
        "{:.1f} cm about it",
        trial, agreed.height, agreed.factor, agreed.factor_sd, agreed.plots,
        100 * agreed.residual_m);
  }
  if (measured->not_found.empty()) return;
  program.say("           measured, and not found: " + joined(measured->not_found));
}

void say_points(const Program& program, const estimate::PointAccount& points, double unit_m) {
  program.say("points     " + text_of(points));
  const auto side = [&](int i) { return points.area_m[i] / unit_m; };
  program.say("field      x {:.1f} to {:.1f}, y {:.1f} to {:.1f} ({})", side(0), side(2), side(1),
              side(3), unit_name(unit_m));
}

void say_ground(const Program& program, const estimate::GroundFacts& ground) {
  const double unknown = 100 * ground.unknown_share;
  program.say("ground     seen in {:.0f} % of {:.1f} m cells{}, noise {:.1f} cm",
              100 * ground.seen_share, ground.cell_m,
              unknown >= 0.5 ? fmt::format(", unknown in {:.0f} % of the grid", unknown) : "",
              100 * ground.noise_m);
}

void say_how(const Program& program, const estimate::Diagnostics& diagnostics, double unit_m) {
  for (const std::string& note : diagnostics.notes.value_or(std::vector<std::string>{}))
    program.say("note       " + note);
  if (diagnostics.points) say_points(program, *diagnostics.points, unit_m);
  if (diagnostics.density_per_m2) {
    program.say("density    " + cloud::density_text(*diagnostics.density_per_m2) +
                " points/m2 (median)");
  }
  if (diagnostics.ground) say_ground(program, *diagnostics.ground);
  for (const std::string& line : diagnostics.lines) program.say(line);
  say_crops(program, diagnostics.crops);
}

void say_flags(const Program& program, const estimate::Estimate& estimate) {
  constexpr std::size_t kNamed = 5;
  std::map<std::string, std::vector<std::string>> ids_by_flag;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    for (const std::string& flag : plot.flags)
      if (!heights::height_of_flag(flag)) ids_by_flag[flag].push_back(plot.id.text());
  }
  for (const auto& [flag, ids] : ids_by_flag) {
    const std::string named = ids.size() <= kNamed ? " (" + joined(ids, ", ") + ")" : "";
    program.say("flagged    {} of {} plots: {}{}", ids.size(), estimate.plots.size(), flag, named);
  }
}

// ", 12 of them unsure by centimetres", of the plots with this height.
std::string unsure_text(const estimate::Estimate& estimate, const std::string& name) {
  const std::string flag = heights::unsure_flag(name);
  const auto unsure = std::ranges::count_if(
      estimate.plots, [&](const auto& plot) { return contains(plot.flags, flag); });
  return unsure == 0 ? "" : fmt::format(", {} of them unsure by centimetres", unsure);
}

void say_heights(const Program& program, const estimate::Estimate& estimate,
                 const nlohmann::json& summary) {
  for (const auto& [name, height] : summary.items()) {
    program.say("{:10} median {:.3f} m, {:.3f} to {:.3f} m, {} plots{}", name,
                height["median_m"].get<double>(), height["min_m"].get<double>(),
                height["max_m"].get<double>(), height["plots"].get<std::size_t>(),
                unsure_text(estimate, name));
  }
}

}  // namespace

void say_estimate(const Program& program, const estimate::Estimate& estimate,
                  const nlohmann::json& summary) {
  say_how(program, estimate.diagnostics, estimate.units ? estimate.units->horizontal_m : 1);
  say_given(program, estimate);
  say_named(program, estimate);
  say_measured(program, estimate);
  say_heights(program, estimate, summary);
  say_flags(program, estimate);
}

}  // namespace plotscan
