// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "core/statistics.h"
#include "plots/lattice/internal/place_canopy.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

// Of the usual side's contrast.
constexpr double kLeastOfSide = 0.25;

// Marks the places of those rows, or columns, of which most plots show no edge at one of the sides
// across r.
void mark_lines(const Lattice& lattice, int Place::*line, std::vector<bool>& marked) {
  constexpr std::size_t kLeastLine = 3;  // plots, where canopy may run on along the line
  const double usual = usual_sides(lattice, contrast_of).r;
  if (usual < kLeastUsual) return;
  std::map<int, std::array<std::vector<double>, 2>> lines;
  for (const Place& place : lattice.places) {
    const std::array<double, 2> contrasts = r_contrasts_of(lattice, place);
    for (std::size_t side = 0; side < 2; ++side)
      lines[place.*line][side].push_back(contrasts[side]);
  }
  const bool along = line == &Place::column;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const auto& [before, after] = lines[lattice.places[i].*line];
    if (along && before.size() < kLeastLine) continue;
    const double least = std::min(quantile(before, 0.5), quantile(after, 0.5));
    if (least < kLeastOfSide * usual) marked[i] = true;
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
  mark_lines(lattice, &Place::row, marked);
  if (!lattice.aligned) return marked;
  const Lattice turned = lattice.turned();
  mark_lines(turned, &Place::row, marked);
  mark_lines(turned, &Place::column, marked);
  mark_lines(lattice, &Place::column, marked);
  return marked;
}

std::size_t count_edgeless(const Lattice& lattice) {
  std::vector<bool> edgeless(lattice.places.size(), false);
  mark_edgeless(lattice, edgeless);
  mark_edgeless(lattice.turned(), edgeless);
  return static_cast<std::size_t>(std::ranges::count(edgeless, true));
}

}  // namespace plotscan::plots
