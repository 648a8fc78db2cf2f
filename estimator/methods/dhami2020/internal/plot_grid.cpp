// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/plot_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>

#include "core/list_of.h"
#include "core/packed_pair.h"
#include "core/statistics.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Index = std::pair<int, int>;  // row and column of the lattice

PlotBox box_at(const Lattice& lattice, const PlotBox& plot, const Index& index) {
  PlotBox box = plot;
  box.center = lattice.point({index.first, index.second});
  return box;
}

// Lattice points along an axis on which the lattice has one line only are not known.
bool is_known(const Lattice& lattice, const Index& index) {
  return (lattice.many_rows || index.first == 0) && (lattice.many_columns || index.second == 0);
}

// The share of each box that canopy covers.
std::map<Index, double> cover_by_index(const Lattice& lattice, const PlotBox& plot,
                                       std::span<const Eigen::Vector3f> canopy, double cell_m) {
  std::unordered_set<std::uint64_t> seen;
  std::map<Index, std::size_t> squares;
  for (const Eigen::Vector3f& point : canopy) {
    const Eigen::Vector2d position = point.head<2>().cast<double>();
    const Eigen::Vector2i nearest = lattice.nearest(position);
    const Index index(nearest.x(), nearest.y());
    if (!is_known(lattice, index) || !box_at(lattice, plot, index).contains(position)) continue;
    const auto x = static_cast<std::int32_t>(std::floor(position.x() / cell_m));
    const auto y = static_cast<std::int32_t>(std::floor(position.y() / cell_m));
    if (seen.insert(packed_pair(x, y)).second) ++squares[index];
  }
  std::map<Index, double> cover;
  for (const auto& [index, count] : squares) {
    cover[index] = static_cast<double>(count) * cell_m * cell_m / plot.area_m2();
  }
  return cover;
}

// The cover of a plot as the clusters see it.
double median_cover(const Lattice& lattice, const std::map<Index, double>& cover,
                    std::span<const Eigen::Vector2d> centers) {
  std::set<Index> held;
  for (const Eigen::Vector2d& center : centers) {
    const Eigen::Vector2i nearest = lattice.nearest(center);
    held.emplace(nearest.x(), nearest.y());
  }
  std::vector<double> covers;
  for (const Index& index : held) {
    const auto found = cover.find(index);
    if (found != cover.end()) covers.push_back(found->second);
  }
  return covers.empty() ? 0 : quantile(covers, 0.5);
}

std::vector<Index> occupied(const std::map<Index, double>& cover, double least_cover,
                            std::size_t most) {
  std::vector<std::pair<double, Index>> candidates;
  for (const auto& [index, share] : cover) {
    if (share >= least_cover) candidates.emplace_back(-share, index);
  }
  std::ranges::sort(candidates);
  if (candidates.size() > most) candidates.resize(most);
  std::vector<Index> indices = list_of(candidates, &std::pair<double, Index>::second);
  std::ranges::sort(indices);
  return indices;
}

// The mean position of the canopy nearest to each lattice point that has any.
std::vector<Eigen::Vector2d> canopy_centroids(const Lattice& lattice,
                                              std::span<const Eigen::Vector3f> canopy) {
  std::map<Index, std::pair<Eigen::Vector2d, std::size_t>> sums;
  for (const Eigen::Vector3f& point : canopy) {
    const Eigen::Vector2d position = point.head<2>().cast<double>();
    const Eigen::Vector2i nearest = lattice.nearest(position);
    const Index index(nearest.x(), nearest.y());
    if (!is_known(lattice, index)) continue;
    auto& [sum, count] = sums.try_emplace(index, Eigen::Vector2d::Zero(), 0).first->second;
    sum += position;
    ++count;
  }
  return list_of<Eigen::Vector2d>(sums, [](const auto& entry) {
    const auto& [sum, count] = entry.second;
    return sum / static_cast<double>(count);
  });
}

}  // namespace

Lattice carried_over(Lattice lattice, const PlotBox& plot,
                     std::span<const Eigen::Vector3f> canopy) {
  int farthest = 0;
  for (const Eigen::Vector3f& point : canopy) {
    const Eigen::Vector2i nearest = lattice.nearest(point.head<2>().cast<double>());
    farthest = std::max(farthest, nearest.cwiseAbs().maxCoeff());
  }
  constexpr int kFirstReach = 4;
  for (int reach = kFirstReach; reach < farthest + farthest / 2 + 2; reach += reach / 2) {
    lattice = refitted(lattice, canopy_centroids(lattice, canopy), plot, reach);
  }
  return lattice;
}

std::vector<estimate::PlotEstimate> fill_lattice(const Lattice& lattice, const PlotBox& plot,
                                                 std::span<const Eigen::Vector3f> canopy,
                                                 std::span<const Eigen::Vector2d> centers,
                                                 double cell_m, std::size_t most) {
  const std::map<Index, double> cover = cover_by_index(lattice, plot, canopy, cell_m);
  const double least_cover = kLeastCover * median_cover(lattice, cover, centers);
  const std::vector<Index> indices = occupied(cover, least_cover, most);
  std::vector<estimate::PlotEstimate> plots;
  if (indices.empty()) return plots;
  const int first_row = indices.front().first;
  const int first_column = std::ranges::min_element(indices, {}, &Index::second)->second;
  for (const Index& index : indices) {
    plots.push_back({.id = static_cast<std::uint32_t>(plots.size() + 1),
                     .row = index.first - first_row + 1,
                     .column = index.second - first_column + 1,
                     .box = box_at(lattice, plot, index)});
  }
  return plots;
}

}  // namespace plotscan::methods::dhami2020
