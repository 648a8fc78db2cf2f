// SPDX-License-Identifier: Apache-2.0
#include "flight/waypoint_file.h"

#include "core/angle.h"
#include "core/list_of.h"
#include "core/yaml_section.h"

namespace plotscan::flight {
namespace {

constexpr std::size_t kMostWaypoints = 100'000;
constexpr Range kPlace_m{-100e3, 100e3};
constexpr Range kAltitude_m{0.5, 120};
constexpr Range kHeading_deg{-360, 360};
constexpr Range kHold_s{0, 3600};

// Asked once all is read: a mistyped key is named as such, not as one that lacks.
void require_one_height(const YamlSection& section) {
  if (section.has("z_m") == section.has("altitude_m"))
    section.fail("z_m", "or altitude_m has to be given, one of the two");
}

StatedWaypoint read_waypoint(const YamlSection& section) {
  StatedWaypoint stated;
  Waypoint& waypoint = stated.waypoint;
  waypoint.position_m = {section.number("x_m", kPlace_m), section.number("y_m", kPlace_m),
                         section.number("z_m", kPlace_m, 0.0)};
  if (section.has("altitude_m")) stated.altitude_m = section.number("altitude_m", kAltitude_m);
  if (section.has("speed_m_s"))
    waypoint.speed_m_s = section.number("speed_m_s", {kMinSpeed_m_s, Quadrotor().max_speed_m_s});
  if (section.has("heading_deg"))
    waypoint.heading_rad = radians(section.number("heading_deg", kHeading_deg));
  waypoint.hold_s = section.number("hold_s", kHold_s, 0.0);
  return stated;
}

}  // namespace

std::vector<StatedWaypoint> read_waypoints(const std::filesystem::path& file) {
  const YamlSection root = YamlSection::load(file, {});
  const std::vector<YamlSection> sections = root.list("waypoints", kMostWaypoints);
  if (sections.size() < 2) root.fail("waypoints", "must list at least two");
  std::vector<StatedWaypoint> waypoints = list_of(sections, read_waypoint);
  root.refuse_unread();
  for (const YamlSection& section : sections) require_one_height(section);
  if (waypoints.back().waypoint.speed_m_s)
    sections.back().fail("speed_m_s", "is of the way from a waypoint on, and this is the last");
  return waypoints;
}

}  // namespace plotscan::flight
