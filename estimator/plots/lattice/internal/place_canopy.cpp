// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/place_canopy.h"

#include <algorithm>
#include <cmath>

namespace plotscan::plots {

namespace {

constexpr double kReach_m = 0.2;  // beyond a plot's sides

}  // namespace

double inner_cover(const Lattice& lattice, const Place& place) {
  const double margin_m = 0.1 * std::min(lattice.r.size_m, lattice.c.size_m);
  const CellBox box = cells_about(lattice, place, -margin_m);
  return lattice.view.cover(box.r0, box.r1, box.c0, box.c1);
}

SideContrast contrast_of(const Lattice& lattice, const Place& place) {
  const auto [r0, r1, c0, c1] = cells_about(lattice, place, 0);
  const int reach = static_cast<int>(std::lround(kReach_m / lattice.view.cell_m()));
  const int r_inset = (r1 - r0) / 8, c_inset = (c1 - c0) / 8;
  const int ra = r0 + r_inset, rb = r1 - r_inset, ca = c0 + c_inset, cb = c1 - c_inset;
  const RowView& view = lattice.view;
  return {.r = (view.cover(r0, r0 + reach, ca, cb) - view.cover(r0 - reach, r0, ca, cb) +
                view.cover(r1 - reach, r1, ca, cb) - view.cover(r1, r1 + reach, ca, cb)) /
               2,
          .c = (view.cover(ra, rb, c0, c0 + reach) - view.cover(ra, rb, c0 - reach, c0) +
                view.cover(ra, rb, c1 - reach, c1) - view.cover(ra, rb, c1, c1 + reach)) /
               2};
}

SideContrast rise_of(const Lattice& lattice, const Place& place) {
  const auto [r0, r1, c0, c1] = cells_about(lattice, place, 0);
  const int reach = static_cast<int>(std::lround(kReach_m / lattice.view.cell_m()));
  const RowView& view = lattice.view;
  const double inner = inner_cover(lattice, place);
  return {
      .r = inner - (view.cover(r0 - reach, r0, c0, c1) + view.cover(r1, r1 + reach, c0, c1)) / 2,
      .c = inner - (view.cover(r0, r1, c0 - reach, c0) + view.cover(r0, r1, c1, c1 + reach)) / 2};
}

}  // namespace plotscan::plots
