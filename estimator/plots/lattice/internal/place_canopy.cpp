// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/place_canopy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kReach_m = 0.2;     // beyond a plot's sides
constexpr double kWithin = 0.1;      // within them, of a plot's shorter side
constexpr double kMoveStep_m = 0.1;  // of sides that are moved, chosen
constexpr double kMostMoved = 0.5;   // of a plot's shorter side: half of it stays in its place

int cells_of(const RowView& view, double length_m) {
  return static_cast<int>(std::lround(length_m / view.cell_m()));
}

std::array<double, 2> contrasts_across_r(const RowView& view, const CellBox& box) {
  const auto [r0, r1, c0, c1] = box;
  const int reach = cells_of(view, kReach_m);
  const int inset = (c1 - c0) / 8, ca = c0 + inset, cb = c1 - inset;
  return {view.cover(r0, r0 + reach, ca, cb) - view.cover(r0 - reach, r0, ca, cb),
          view.cover(r1 - reach, r1, ca, cb) - view.cover(r1, r1 + reach, ca, cb)};
}

// Mean cover within a box, off its edges, less that beyond its sides across r.
double rise_across_r(const RowView& view, const CellBox& box, int r_margin, int c_margin) {
  const auto [r0, r1, c0, c1] = box;
  const int reach = cells_of(view, kReach_m);
  return view.cover(r0 + r_margin, r1 - r_margin, c0 + c_margin, c1 - c_margin) -
         (view.cover(r0 - reach, r0, c0, c1) + view.cover(r1, r1 + reach, c0, c1)) / 2;
}

// The middle half along c: leaves of what stands beside hang over the rest.
CellBox middle_in_c(const CellBox& box) {
  const int quarter = (box.c1 - box.c0) / 4;
  return {box.r0, box.r1, box.c0 + quarter, box.c1 - quarter};
}

}  // namespace

double inner_cover(const Lattice& lattice, const Place& place) {
  const double margin_m = kWithin * std::min(lattice.r.size_m, lattice.c.size_m);
  const CellBox box = cells_about(lattice, place, -margin_m);
  return lattice.view.cover(box.r0, box.r1, box.c0, box.c1);
}

std::array<double, 2> r_contrasts_of(const Lattice& lattice, const Place& place) {
  return contrasts_across_r(lattice.view, cells_about(lattice, place, 0));
}

SideContrast contrast_of(const Lattice& lattice, const Place& place) {
  const auto [r0, r1, c0, c1] = cells_about(lattice, place, 0);
  const auto r = contrasts_across_r(lattice.view, {r0, r1, c0, c1});
  const auto c = contrasts_across_r(lattice.view.turned(), {c0, c1, r0, r1});
  return {.r = (r[0] + r[1]) / 2, .c = (c[0] + c[1]) / 2};
}

double mean_at_gaps(const Lattice& lattice, const SideContrast& contrast) {
  if (lattice.r.touching_m.has_value() == lattice.c.touching_m.has_value()) return contrast.mean();
  return lattice.r.touching_m ? contrast.c : contrast.r;
}

SideContrast rise_of(const Lattice& lattice, const Place& place) {
  const double width_m = std::min(lattice.r.size_m, lattice.c.size_m);
  const int margin = cells_of(lattice.view, kWithin * width_m);
  const CellBox box = cells_about(lattice, place, 0);
  const CellBox turned = {box.c0, box.c1, box.r0, box.r1};
  const bool touches_r = lattice.r.touching_m.has_value();
  const bool touches_c = lattice.c.touching_m.has_value();
  if (touches_r == touches_c)
    return {.r = rise_across_r(lattice.view, box, margin, margin),
            .c = rise_across_r(lattice.view.turned(), turned, margin, margin)};
  const double rise = touches_c
                          ? rise_across_r(lattice.view, middle_in_c(box), margin, 0)
                          : rise_across_r(lattice.view.turned(), middle_in_c(turned), margin, 0);
  return {.r = rise, .c = rise};
}

SideContrast usual_sides(const Lattice& lattice,
                         SideContrast (*of_place)(const Lattice& lattice, const Place& place)) {
  std::vector<double> along_r, along_c;
  for (const Place& place : lattice.places) {
    if (!place.full) continue;
    const SideContrast of = of_place(lattice, place);
    along_r.push_back(of.r);
    along_c.push_back(of.c);
  }
  return {.r = quantile(std::move(along_r), 0.5), .c = quantile(std::move(along_c), 0.5)};
}

UsualPlot usual_plot(const Lattice& lattice) {
  std::vector<double> covers;
  for (const Place& place : lattice.places)
    if (place.full) covers.push_back(inner_cover(lattice, place));
  return {.cover = quantile(std::move(covers), 0.5), .contrast = usual_sides(lattice, contrast_of)};
}

double contrast_moved(const Lattice& lattice, const Place& place, const SideContrast& usual) {
  const double most_m = kMostMoved * std::min(lattice.r.size_m, lattice.c.size_m);
  const int steps = static_cast<int>(most_m / kMoveStep_m);
  double best = -std::numeric_limits<double>::infinity();
  for (int r = -steps; r <= steps; ++r) {
    for (int c = -steps; c <= steps; ++c) {
      if (std::hypot(r, c) > steps) continue;
      Place moved = place;
      moved.r_m += r * kMoveStep_m;
      moved.c_m += c * kMoveStep_m;
      const SideContrast of = contrast_of(lattice, moved);
      best = std::max(best, std::min(of.r / usual.r, of.c / usual.c));
    }
  }
  return best;
}

}  // namespace plotscan::plots
