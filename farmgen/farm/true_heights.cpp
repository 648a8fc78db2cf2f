// SPDX-License-Identifier: Apache-2.0
#include "farm/true_heights.h"

#include <algorithm>
#include <limits>

#include "core/contains.h"
#include "core/random.h"
#include "core/statistics.h"

namespace plotscan::farm {
namespace {

constexpr std::size_t kHandMeasured = 3;

// Up to `wanted` different values below `count`, every set as likely as another (Floyd's algorithm;
// Bentley and Floyd, CACM 1987).
std::vector<std::size_t> sample(std::size_t count, std::size_t wanted, RandomStream random) {
  std::vector<std::size_t> chosen;
  for (std::size_t last = count - std::min(count, wanted); last < count; ++last) {
    const std::size_t pick = random.below(last + 1);
    const bool taken = contains(chosen, pick);
    chosen.push_back(taken ? last : pick);
  }
  return chosen;
}

}  // namespace

double placed_height(const PlantModel& model, const Plant& plant, double ground_z) {
  const double foot = plant.position.z() - ground_z;
  const bool upright = plant.rotation.x() == 0 && plant.rotation.y() == 0;
  if (upright) return foot + plant.scale.z() * model.height_m;
  const Eigen::Matrix3d linear =
      plant.rotation.toRotationMatrix() * plant.scale.asDiagonal().toDenseMatrix();
  const Eigen::RowVector3d up = linear.row(2);
  double highest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : model.mesh.vertices)
    highest = std::max(highest, up.dot(vertex.cast<double>()));
  return foot + highest;
}

PlotHeights plot_heights(const std::vector<double>& plant_heights, std::uint64_t seed,
                         std::uint32_t plot_id) {
  if (plant_heights.empty()) return {};
  std::vector<double> hand;
  for (const std::size_t plant :
       sample(plant_heights.size(), kHandMeasured, {seed, random_purpose("plot/hand3"), plot_id}))
    hand.push_back(plant_heights[plant]);
  return {.mean = mean(plant_heights),
          .max = quantile(plant_heights, 1.0),
          .p50 = quantile(plant_heights, 0.5),
          .p90 = quantile(plant_heights, 0.9),
          .p95 = quantile(plant_heights, 0.95),
          .p99 = quantile(plant_heights, 0.99),
          .hand3 = mean(hand)};
}

}  // namespace plotscan::farm
