// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/lower_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/statistics.h"
#include "ground/internal/solver.h"

namespace plotscan::ground {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

struct OneLayer {
  float z_m = kNone;
  float weight = 0;
  float returns = 0;
  float scatter_m2 = 0;
};

// The height that one in a hundred lies under; changes the order.
float lowest_hundredth(std::vector<float>& z) {
  const std::size_t low = z.size() / 100;
  if (low > 0) return selected<float>(z, low);
  float least = kNone;
#pragma omp simd reduction(min : least)
  for (std::size_t k = 0; k < z.size(); ++k) least = std::min(least, z[k]);
  return least;
}

// The mean of the values at most `reach` from `middle`; `middle` where there are none.
float mean_about(std::span<const float> z, float middle, float reach) {
  float sum = 0;
  int count = 0;
#pragma omp simd reduction(+ : sum, count)
  for (std::size_t k = 0; k < z.size(); ++k) {
    const bool near = std::abs(z[k] - middle) <= reach;
    sum += near ? z[k] : 0;
    count += static_cast<int>(near);
  }
  return count > 0 ? sum / static_cast<float>(count) : middle;
}

// The layer at the bottom of one column: the mean of the returns near it, starting from the lowest
// hundredth, and their share among all returns near and right above it.
OneLayer layer_of(std::span<const Return> returns, const Eigen::Vector2f& tilt, float noise,
                  std::vector<float>& z) {
  if (returns.empty()) return {};
  z.resize(returns.size());
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = returns[k].z_m - tilt.x() * returns[k].east() - tilt.y() * returns[k].north();
  float middle = lowest_hundredth(z) + 1.5f * noise;
  for (int k = 0; k < 3; ++k) middle = mean_about(z, middle, 2 * noise);
  int about = 0;
  int above = 0;
  float squares = 0;
#pragma omp simd reduction(+ : about, above, squares)
  for (std::size_t k = 0; k < z.size(); ++k) {
    const float off = z[k] - middle;
    const bool is_about = std::abs(off) <= 3 * noise;
    about += static_cast<int>(is_about);
    squares += is_about ? off * off : 0;
    above += static_cast<int>(off > 3 * noise) & static_cast<int>(off <= 9 * noise);
  }
  const float share = static_cast<float>(about) / static_cast<float>(about + above + 1);
  return {.z_m = middle,
          .weight = share * share,
          .returns = static_cast<float>(about),
          .scatter_m2 = squares / static_cast<float>(std::max(1, about))};
}

// Rise of a surface along a column of the grid, metres a cell.
Eigen::Vector2f tilt_at(const Grid& grid, const Field& s, int column, int row) {
  const int west = std::max(0, column - 1);
  const int east = std::min(grid.columns - 1, column + 1);
  const int south = std::max(0, row - 1);
  const int north = std::min(grid.rows - 1, row + 1);
  return {(s[grid.index(east, row)] - s[grid.index(west, row)]) / static_cast<float>(east - west),
          (s[grid.index(column, north)] - s[grid.index(column, south)]) /
              static_cast<float>(north - south)};
}

Layer lowest_layer(const Columns& columns, const Field& surface, float noise) {
  const Grid& grid = columns.grid;
  Layer layer{.z_m = Field(grid.nodes()),
              .weight = Field(grid.nodes()),
              .returns = Field(grid.nodes()),
              .scatter = Field(grid.nodes())};
  for_rows(grid, [&](int row) {
    std::vector<float> z;
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      const OneLayer here = layer_of(columns.at(i), tilt_at(grid, surface, column, row), noise, z);
      layer.z_m[i] = here.z_m;
      layer.weight[i] = here.weight;
      layer.returns[i] = here.returns;
      layer.scatter[i] = here.scatter_m2;
    }
  });
  return layer;
}

// Removes layers so far below their surroundings that no ground can connect them: echoes of birds,
// multipath.
void drop_strays(const Grid& grid, float noise, Layer& layer) {
  const float deepest = 6 * noise + 2.0f * 1.5f * static_cast<float>(grid.cell_m);
  Layer kept = layer;
  for_rows(grid, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      std::array<float, 24> around;
      int count = 0;
      const std::size_t i = grid.index(column, row);
      for_around(grid, column, row, 2, [&](std::size_t near) {
        if (near != i && layer.z_m[near] < kNone) around[count++] = layer.z_m[near];
      });
      if (count < 3) continue;
      if (layer.z_m[i] < selected_low(std::span(around.data(), count), 2) - deepest) {
        kept.z_m[i] = kNone;
        kept.weight[i] = 0;
      }
    }
  });
  layer = kept;
}

// Median of the finite among the 3 x 3 nodes around each; 0 where there is none.
Field median_around(const Grid& grid, const Field& z) {
  Field medians(grid.nodes(), 0);
  for_rows(grid, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      std::array<float, 9> around;
      int count = 0;
      for_around(grid, column, row, 1, [&](std::size_t near) {
        if (z[near] < kNone) around[count++] = z[near];
      });
      if (count == 0) continue;
      medians[grid.index(column, row)] = selected(std::span(around.data(), count), count / 2);
    }
  });
  return medians;
}

// Asymmetric, redescending weights: layers above the surface soon have no weight.
Field asymmetric_weights(const Layer& layer, const Field& surface, float scale) {
  Field weights(surface.size(), 0);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!(layer.z_m[i] < kNone)) continue;
    const float off = layer.z_m[i] - surface[i];
    const float share = off / (off > 0 ? scale : 4 * scale);
    const float falloff = 1 + share * share;
    weights[i] = layer.weight[i] / (falloff * falloff);
  }
  return weights;
}

// Redescending weights that are the same on both sides.
Field robust_weights(const Layer& layer, const Field& surface, float scale) {
  Field weights(surface.size(), 0);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!(layer.z_m[i] < kNone)) continue;
    const float share = (layer.z_m[i] - surface[i]) / scale;
    weights[i] = layer.weight[i] / (1 + share * share);
  }
  return weights;
}

Field finite(const Field& z) {
  Field result = z;
  for (float& value : result) {
    if (!(value < kNone)) value = 0;
  }
  return result;
}

// Calls relax(node, neighbour, distance in cells) for the neighbours of every node, in the two
// sweeps of a chamfer distance (Borgefors, 1986).
template <class Relax>
void for_chamfer_steps(const Grid& grid, const Relax& relax) {
  const float askew = std::sqrt(2.0f);
  const auto step = [&](int c, int r, int dc, int dr, float cells) {
    if (c + dc < 0 || c + dc >= grid.columns || r + dr < 0 || r + dr >= grid.rows) return;
    relax(grid.index(c, r), grid.index(c + dc, r + dr), cells);
  };
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      step(c, r, -1, 0, 1);
      step(c, r, 0, -1, 1);
      step(c, r, -1, -1, askew);
      step(c, r, 1, -1, askew);
    }
  }
  for (int r = grid.rows - 1; r >= 0; --r) {
    for (int c = grid.columns - 1; c >= 0; --c) {
      step(c, r, 1, 0, 1);
      step(c, r, 0, 1, 1);
      step(c, r, 1, 1, askew);
      step(c, r, -1, 1, askew);
    }
  }
}

// Where z is infinite, that of the nearest node where it is not.
Field filled_from_nearest(const Grid& grid, const Field& z) {
  Field filled = z;
  Field distance(grid.nodes());
  for (std::size_t i = 0; i < grid.nodes(); ++i) distance[i] = z[i] < kNone ? 0 : kNone;
  for_chamfer_steps(grid, [&](std::size_t here, std::size_t neighbour, float cells) {
    if (!(distance[neighbour] + cells < distance[here])) return;
    distance[here] = distance[neighbour] + cells;
    filled[here] = filled[neighbour];
  });
  return filled;
}

// The highest surface under the layers that is nowhere too steep for a field; level beyond them.
Field first_lower_surface(const Grid& grid, const Field& layers) {
  constexpr double kSteepest = 2.5;
  Field surface = slope_limited(grid, layers, kSteepest);
  for (std::size_t i = 0; i < surface.size(); ++i)
    if (!(layers[i] < kNone)) surface[i] = kNone;
  return finite(filled_from_nearest(grid, surface));
}

}  // namespace

Field slope_limited(const Grid& grid, const Field& z, double slope) {
  Field s = z;
  for_chamfer_steps(grid, [&](std::size_t here, std::size_t neighbour, float cells) {
    s[here] = std::min(s[here], s[neighbour] + static_cast<float>(slope * grid.cell_m) * cells);
  });
  return s;
}

Layer upright_layer(const Columns& columns, double noise_m) {
  return lowest_layer(columns, Field(columns.grid.nodes(), 0), static_cast<float>(noise_m));
}

Field lower_surface(const Columns& columns, const Layer& upright, double noise_m) {
  const Grid& grid = columns.grid;
  const auto noise = static_cast<float>(noise_m);
  Field surface(grid.nodes(), 0);
  struct Stage {
    float length_cells, scale_m;
  };
  for (int round = 0; round < 2; ++round) {
    Layer layer = round == 0 ? upright : lowest_layer(columns, surface, noise);
    drop_strays(grid, noise, layer);
    if (round == 0) surface = first_lower_surface(grid, layer.z_m);
    const std::vector<Stage> stages =
        round == 0 ? std::vector<Stage>{{6, 0.4f}, {5, 0.25f}, {4, 0.15f}, {3, 0.1f}, {3, 0.1f}}
                   : std::vector<Stage>{{3, 0.08f}, {2, 0.06f}};
    for (const Stage& stage : stages) {
      const Fit fit{.target = finite(layer.z_m),
                    .data = asymmetric_weights(layer, surface, stage.scale_m + 2 * noise),
                    .stiffness = Field(grid.nodes(), std::pow(stage.length_cells, 4.0f))};
      solve(grid, fit, {.most_iterations = 150, .tolerance_m = 0.002}, surface);
    }
  }
  return surface;
}

LayerSurface layer_surface(const Columns& columns, const Layer& upright, double noise_m) {
  const Grid& grid = columns.grid;
  const auto noise = static_cast<float>(noise_m);
  Field surface = median_around(grid, upright.z_m);
  Layer layer;
  for (const float stiffness : {0.3f, 0.1f, 0.03f}) {
    layer = lowest_layer(columns, surface, noise);
    drop_strays(grid, noise, layer);
    for (const float scale_m : {0.1f, 0.06f}) {
      const Fit fit{.target = finite(layer.z_m),
                    .data = robust_weights(layer, surface, scale_m + 2 * noise),
                    .stiffness = Field(grid.nodes(), stiffness)};
      solve(grid, fit, {.most_iterations = 100, .tolerance_m = 0.002}, surface);
    }
  }
  return {.z_m = std::move(surface), .layer = std::move(layer)};
}

}  // namespace plotscan::ground
