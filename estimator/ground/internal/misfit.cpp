// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/misfit.h"

#include <algorithm>
#include <cmath>

#include "ground/internal/pool.h"

namespace plotscan::ground {
namespace {

// Cells on either side whose layers count for a node, and those that stand in where these are few:
// their mean is worth kPrior layers.
constexpr int kNear = 2;
constexpr int kFar = 6;
constexpr float kPrior = 0.3f;
// Layers above the surface count up to this many standard errors.
constexpr float kMostAbove = 2.5f;
// Limit for a layer that determines the surface almost alone: it says little of the surface without
// it.
constexpr float kMostLeverage = 0.8f;
// From this many returns per layer on, noise and ground can be told apart.
constexpr double kTelling = 8;
// The spread of errors over the squared mean of their square roots: 1.48 of normal ones, less of
// what lies between few returns (docs/ground.md, step 8).
constexpr float kSpreadOfRoots = 1.18f;

// Where the ground shows itself at a node.
struct Shown {
  float off_m = 0;    // above the surface; not finite where nothing shows it
  float more_m2 = 0;  // mean square of a single place beside off_m's; negative: off_m's own noise
};

// Sizes of the distances of the ground that is shown from the surface, by node.
struct Sizes {
  Sizes(std::size_t count, bool noise_is_shown) : many(noise_is_shown), size(count), nodes(count) {}
  bool many;    // whether noise and ground are told apart
  Field size;   // of a distance (size_of)
  Field nodes;  // 1 where there is one; pooled: how many
};

// What is pooled for a squared distance: the square itself, from which noise is subtracted later;
// where returns are few, its fourth root, since a few roofs and woods would dominate a mean of
// squares.
float size_of(float square_m2, bool many) {
  return many ? square_m2 : std::sqrt(std::sqrt(square_m2));
}
float usual_spread(float mean_size, bool many) {
  return many ? std::sqrt(mean_size) : kSpreadOfRoots * mean_size * mean_size;
}

// Whether most layers have returns enough to tell the noise from the ground.
bool shows_noise(const Layer& layer) {
  double returns = 0, layers = 0;
  for (const float count : layer.returns) {
    returns += count;
    layers += count > 0;
  }
  return returns >= kTelling * layers;
}

// With many returns the mean is known, and its noise is no error of the surface. With few, noise
// and ground cannot be told apart: all their scatter counts as ground.
Shown shown_at(std::size_t i, const Layer& layer, const Fitted& fitted, bool many) {
  const Evidence& evidence = fitted.evidence;
  if (many && evidence.data[i] > 0)
    return {.off_m = evidence.target_m[i] - fitted.z_m[i], .more_m2 = -1 / evidence.data[i]};
  return {.off_m = layer.z_m[i] - fitted.z_m[i], .more_m2 = many ? 0 : layer.scatter[i]};
}

// Adds the nodes for which counts(node, distance) holds. Ground that pulled the surface counts by
// its deleted residual, r / (1 - leverage): its distance from the surface fitted without it (Cook
// and Weisberg, "Residuals and Influence in Regression", 1982; the formula as in statsmodels,
// OLSInfluence.resid_press).
template <class Counts>
void add(const Layer& layer, const Fitted& fitted, const Counts& counts, Sizes& sizes) {
  for (std::size_t i = 0; i < fitted.z_m.size(); ++i) {
    const Shown shown = shown_at(i, layer, fitted, sizes.many);
    if (!std::isfinite(shown.off_m) || !counts(i, shown.off_m)) continue;
    const float leverage =
        std::min(kMostLeverage, fitted.evidence.data[i] * fitted.sd_m[i] * fitted.sd_m[i]);
    const float alone = shown.off_m / (1 - leverage);
    sizes.size[i] = size_of(alone * alone + shown.more_m2, sizes.many);
    sizes.nodes[i] = 1;
  }
}

Sizes pooled(const Grid& grid, int around, Sizes sizes) {
  pool(grid, around, sizes.size);
  pool(grid, around, sizes.nodes);
  return sizes;
}

// Spread of the distances around each node.
Field spread_around(const Grid& grid, const Sizes& sizes) {
  double sum = 0, nodes = 0;
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    sum += sizes.size[i];
    nodes += sizes.nodes[i];
  }
  const auto usual = static_cast<float>(std::max(0.0, sum / std::max(1.0, nodes)));
  const Sizes far = pooled(grid, kFar, sizes);
  const Sizes near = pooled(grid, kNear, sizes);
  Field spread_m(grid.nodes());
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    const float wide = std::max(0.0f, far.size[i] + kPrior * usual) / (far.nodes[i] + kPrior);
    const float here = std::max(0.0f, near.size[i] + kPrior * wide) / (near.nodes[i] + kPrior);
    spread_m[i] = usual_spread(here, sizes.many);
  }
  return spread_m;
}

}  // namespace

Field misfit(const Grid& grid, const Layer& layer, const Fitted& fitted) {
  Sizes sizes(grid.nodes(), shows_noise(layer));
  add(
      layer, fitted, [](std::size_t, float off_m) { return off_m < 0; }, sizes);
  const Field below_m = spread_around(grid, sizes);
  const auto as_near = [&](std::size_t i, float off_m) {
    return off_m >= 0 && off_m < kMostAbove * std::hypot(fitted.sd_m[i], below_m[i]);
  };
  add(layer, fitted, as_near, sizes);
  return spread_around(grid, sizes);
}

}  // namespace plotscan::ground
