// SPDX-License-Identifier: Apache-2.0
#include "ground/misfit.h"

#include <algorithm>
#include <cmath>

#include "ground/pool.h"

namespace plotscan::ground {
namespace {

// Cells on either side whose layers count for a node, and those that stand in where these are few:
// their mean square is worth kPrior layers.
constexpr int kNear = 2;
constexpr int kFar = 6;
constexpr float kPrior = 0.3f;
// Layers above the surface count up to so many standard errors.
constexpr float kAbove = 2.5f;
// A layer that holds the surface almost by itself tells little of what it would be without.
constexpr float kMostLeverage = 0.8f;
// From so many returns a layer on, noise and ground can be told apart.
constexpr double kTelling = 8;

// Where the ground shows itself at a node.
struct Shown {
  float off_m = 0;    // above the surface; not finite where nothing shows it
  float more_m2 = 0;  // mean square of a single place beside off_m's; negative: off_m's own noise
};

// Squared distances of the ground that is shown from the surface, by node.
struct Squares {
  explicit Squares(std::size_t size) : m2(size), nodes(size) {}
  Field m2;
  Field nodes;  // 1 where there is one; pooled: how many
};

// Whether most layers have returns enough to tell the noise from the ground.
bool shows_noise(const Layer& layer) {
  double returns = 0, layers = 0;
  for (const float count : layer.returns) {
    returns += count;
    layers += count > 0;
  }
  return returns >= kTelling * layers;
}

// Many returns show a mean, whose noise is known and no error of the surface. Few do not tell noise
// from ground: all that they scatter counts as ground.
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
void add(const Layer& layer, const Fitted& fitted, bool many, const Counts& counts,
         Squares& squares) {
  for (std::size_t i = 0; i < fitted.z_m.size(); ++i) {
    const Shown shown = shown_at(i, layer, fitted, many);
    if (!std::isfinite(shown.off_m) || !counts(i, shown.off_m)) continue;
    const float leverage =
        std::min(kMostLeverage, fitted.evidence.data[i] * fitted.sd_m[i] * fitted.sd_m[i]);
    const float alone = shown.off_m / (1 - leverage);
    squares.m2[i] = alone * alone + shown.more_m2;
    squares.nodes[i] = 1;
  }
}

Squares pooled(const Grid& grid, int around, Squares squares) {
  pool(grid, around, squares.m2);
  pool(grid, around, squares.nodes);
  return squares;
}

// Root mean square around each node.
Field rms_around(const Grid& grid, const Squares& squares) {
  double sum_m2 = 0, nodes = 0;
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    sum_m2 += squares.m2[i];
    nodes += squares.nodes[i];
  }
  const auto usual = static_cast<float>(std::max(0.0, sum_m2 / std::max(1.0, nodes)));
  const Squares far = pooled(grid, kFar, squares);
  const Squares near = pooled(grid, kNear, squares);
  Field rms_m(grid.nodes());
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    const float wide = std::max(0.0f, far.m2[i] + kPrior * usual) / (far.nodes[i] + kPrior);
    const float here = std::max(0.0f, near.m2[i] + kPrior * wide) / (near.nodes[i] + kPrior);
    rms_m[i] = std::sqrt(here);
  }
  return rms_m;
}

}  // namespace

Field misfit(const Grid& grid, const Layer& layer, const Fitted& fitted) {
  const bool many = shows_noise(layer);
  Squares squares(grid.nodes());
  add(
      layer, fitted, many, [](std::size_t, float off_m) { return off_m < 0; }, squares);
  const Field below_m = rms_around(grid, squares);
  const auto as_near = [&](std::size_t i, float off_m) {
    return off_m >= 0 && off_m < kAbove * std::hypot(fitted.sd_m[i], below_m[i]);
  };
  add(layer, fitted, many, as_near, squares);
  return rms_around(grid, squares);
}

}  // namespace plotscan::ground
