// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/plot_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "core/statistics.h"
#include "plots/lattice/internal/place_canopy.h"

namespace plotscan::plots {
namespace {

// Of the usual side's contrast, in the mean of a row or column.
constexpr double kLeastOfSide = 0.25;
// Where the usual side shows less there is no edge to miss: drill rows end within the box, plots
// touch.
constexpr double kLeastUsual = 0.2;

// Marks the places of those rows in which one of the sides across r shows no edge.
void mark_rows(const Lattice& lattice, std::vector<bool>& marked) {
  const double usual = usual_sides(lattice, contrast_of).r;
  if (usual < kLeastUsual) return;
  std::map<int, std::array<std::vector<double>, 2>> rows;
  for (const Place& place : lattice.places) {
    const std::array<double, 2> contrasts = r_contrasts_of(lattice, place);
    for (std::size_t side = 0; side < 2; ++side) rows[place.row][side].push_back(contrasts[side]);
  }
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const auto& sides = rows[lattice.places[i].row];
    if (std::min(mean(sides[0]), mean(sides[1])) < kLeastOfSide * usual) marked[i] = true;
  }
}

}  // namespace

bool is_cut_off(const Lattice& lattice, const Place& place) {
  constexpr double kBeside_m = 0.3, kLeastShare = 0.25;
  const auto [r0, r1, c0, c1] = cells_about(lattice, place, 0);
  const int beyond = static_cast<int>(std::lround(kBeside_m / lattice.view.cell_m()));
  const auto share = [&](int ra, int rb, int ca, int cb) {
    return lattice.view.seen_cells(ra, rb, ca, cb) / std::max(1.0, 1.0 * (rb - ra) * (cb - ca));
  };
  const double least = kLeastShare * share(r0, r1, c0, c1);
  return share(r0 - beyond, r0, c0, c1) < least || share(r1, r1 + beyond, c0, c1) < least ||
         share(r0, r1, c0 - beyond, c0) < least || share(r0, r1, c1, c1 + beyond) < least;
}

std::vector<bool> without_edge(const Lattice& lattice) {
  std::vector<bool> marked(lattice.places.size(), false);
  mark_rows(lattice, marked);
  if (lattice.aligned) mark_rows(lattice.turned(), marked);
  return marked;
}

}  // namespace plotscan::plots
