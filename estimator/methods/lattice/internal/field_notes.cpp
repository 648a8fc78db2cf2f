// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/field_notes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "cloud/area.h"
#include "cloud/coordinate_step.h"
#include "cloud/field_density.h"
#include "core/angle.h"
#include "core/list_of.h"
#include "core/text.h"
#include "methods/lattice/internal/shifted_boxes.h"

namespace plotscan::methods::lattice {
namespace {

void add_note(std::string note, estimate::Diagnostics& diagnostics) {
  if (!diagnostics.notes) diagnostics.notes.emplace();
  diagnostics.notes->push_back(std::move(note));
}

// "0.9 m east and 0.3 m south"; decimetres, of which one is not zero.
std::string move_text(const Eigen::Vector2d& by_m) {
  constexpr double kLeast_m = 0.05;
  std::vector<std::string> parts;
  if (std::abs(by_m.x()) >= kLeast_m)
    parts.push_back(fmt::format("{:.1f} m {}", std::abs(by_m.x()), by_m.x() > 0 ? "east" : "west"));
  if (std::abs(by_m.y()) >= kLeast_m)
    parts.push_back(
        fmt::format("{:.1f} m {}", std::abs(by_m.y()), by_m.y() > 0 ? "north" : "south"));
  return joined(parts, " and ");
}

}  // namespace

std::string too_few(const std::string& for_what) {
  return fmt::format("too few points to show {}: about {:.0f} a square metre are needed", for_what,
                     cloud::kPlotsFound_m2);
}

std::string why_none(const std::string& by_plots, double density_m2, double noise_m,
                     const Options& options) {
  constexpr double kRough_m = 0.05;  // sensors and strips that fit scatter less
  std::string why = by_plots;
  if (options.heading_deg)
    why += fmt::format("; searched along and across --heading {:g} only", *options.heading_deg);
  if (noise_m > kRough_m)
    why += fmt::format(
        "; the ground's returns scatter by {:.1f} cm, which hides canopy: the ground was "
        "removed, strips lie apart in height, or noise{}",
        100 * noise_m, options.noise_m ? "" : "; if strips lie apart, give the sensor's --noise");
  return density_m2 < cloud::kPlotsFound_m2 ? too_few("plots") + " (" + why + ")" : why;
}

std::string no_ground_because(const cloud::FieldCloud& cloud,
                              const estimate::PointAccount& points) {
  const double kept_m2 =
      static_cast<double>(cloud.counts.kept) / cloud::sides_of(cloud.area).prod();
  const std::string seen =
      " (" + text_of(points) + "; " + cloud::density_text(cloud.density_m2) + " points/m2); ";
  if (std::min(kept_m2, cloud.density_m2) < cloud::kLeastSearched_m2)
    return too_few("ground and plots") + seen + "fly lower or slower for more points";
  return "the cloud shows no ground" + seen + "cut it to the field with --crop-box";
}

void note_heading(const plots::PlotField& trial, const Options& options,
                  estimate::Diagnostics& diagnostics) {
  if (!options.heading_deg || trial.plots.empty()) return;
  const double heading_rad = trial.plots.front().box.heading_rad;
  const double off_rad = std::remainder(heading_rad - radians(*options.heading_deg), kPi);
  if (std::abs(off_rad) < kPi / 4) return;
  add_note(fmt::format("the plots are longer along {:.0f} degrees than along --heading {:g}",
                       heading_rad / kDegrees, *options.heading_deg),
           diagnostics);
}

void note_noise(const ground::Surface& surface, const Options& options,
                estimate::Diagnostics& diagnostics) {
  if (!options.noise_m || surface.noise_m > surface.noise_seen_m / 2) return;
  add_note(fmt::format("heights of bare ground scatter by {:.1f} cm, over twice what --noise says",
                       100 * surface.noise_seen_m),
           diagnostics);
}

void note_steps(const cloud::FieldCloud& cloud, estimate::Diagnostics& diagnostics) {
  cloud::CoordinateSteps steps;
  std::vector<Eigen::Vector3d> one(1);
  for (const Eigen::Vector3f& point : cloud.points) {
    one[0] = point.cast<double>();
    steps.add(one);
  }
  std::string note = cloud::step_note(steps.steps_m(), cloud.density_m2);
  if (!note.empty()) add_note(std::move(note), diagnostics);
}

void note_shift(std::span<const Eigen::Vector3f> heights,
                const std::vector<estimate::PlotEstimate>& given, double noise_m,
                estimate::Diagnostics& diagnostics) {
  const auto shifted =
      shifted_boxes(heights, list_of(given, &estimate::PlotEstimate::box), noise_m);
  if (!shifted) return;
  add_note(
      fmt::format("the given boxes lie beside the canopy, which covers {:.0f} % of them; "
                  "moved {} it would cover {:.0f} %: is the map of another survey, or in "
                  "another coordinate system?",
                  100 * shifted->covered, move_text(shifted->by_m), 100 * shifted->covered_there),
      diagnostics);
}

}  // namespace plotscan::methods::lattice
