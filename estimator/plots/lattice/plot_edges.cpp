// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/plot_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "core/statistics.h"
#include "plots/lattice/internal/place_canopy.h"

namespace plotscan::plots {
namespace {

// Of the usual side's contrast, in the mean of a row or column.
constexpr double kLeastOfSide = 0.25;

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

// Marks the places that show no edge at one of the sides across r, where one in five shows clear
// ones.
void mark_edgeless(const Lattice& lattice, std::vector<bool>& marked) {
  constexpr double kClear = 0.8;  // quantile
  std::vector<double> least;
  for (const Place& place : lattice.places)
    least.push_back(std::ranges::min(r_contrasts_of(lattice, place)));
  const double clear = quantile(least, kClear);
  if (clear < kLeastUsual) return;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (least[i] < kLeastOfSide * clear) marked[i] = true;
}

}  // namespace

std::vector<bool> without_edge(const Lattice& lattice) {
  std::vector<bool> marked(lattice.places.size(), false);
  mark_rows(lattice, marked);
  if (lattice.aligned) mark_rows(lattice.turned(), marked);
  return marked;
}

std::size_t count_edgeless(const Lattice& lattice) {
  std::vector<bool> edgeless(lattice.places.size(), false);
  mark_edgeless(lattice, edgeless);
  mark_edgeless(lattice.turned(), edgeless);
  return static_cast<std::size_t>(std::ranges::count(edgeless, true));
}

}  // namespace plotscan::plots
