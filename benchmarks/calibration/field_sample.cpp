// SPDX-License-Identifier: Apache-2.0
#include "calibration/field_sample.h"

#include <algorithm>
#include <cmath>

#include "calibration/perfect_returns.h"
#include "core/extent.h"
#include "core/random.h"
#include "core/statistics.h"
#include "core/temporary_path.h"
#include "description/load_description.h"
#include "lidar/canopy_height.h"
#include "planting/generate.h"
#include "scan/cloud_reader.h"

namespace plotscan::calibration {
namespace {

// Returns about true ground this near count for its noise.
constexpr double kBare_m = 0.15;

// The true ground as a fitted one would be given: nodes over the plots and a margin.
ground::Surface true_surface(const farm::Farm& farm, double noise_m) {
  constexpr double kMargin_m = 2;
  constexpr float kStandardError_m = 0.003F;
  ground::Surface surface{{.cell_m = 0.1}};
  const Eigen::AlignedBox2d extent = extent_of(farm.plots, &farm::Plot::box);
  surface.origin = extent.min().array() - kMargin_m;
  const Eigen::Vector2i size =
      (extent.sizes().array() / surface.cell_m + 2 * kMargin_m / surface.cell_m).cast<int>() + 1;
  surface.columns = size.x();
  surface.rows = size.y();
  for (int row = 0; row < surface.rows; ++row) {
    for (int column = 0; column < surface.columns; ++column) {
      const Eigen::Vector2d node = surface.origin + surface.cell_m * Eigen::Vector2d(column, row);
      surface.z_m.push_back(
          static_cast<float>(farm.terrain.height(node.x(), node.y()).value_or(kNaN)));
    }
  }
  surface.sd_m.assign(surface.z_m.size(), kStandardError_m);
  surface.seen.assign(surface.z_m.size(), 1);
  surface.noise_m = noise_m;
  return surface;
}

// Sigma of the heights of returns about true ground between the plots: from their median distance.
double bare_noise(const farm::Farm& farm, const std::vector<Eigen::Vector3f>& points) {
  std::vector<double> distances;
  const farm::Plot& first = farm.plots.front();
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Eigen::Vector2d place = points[i].head<2>().cast<double>();
    const double reach_m = (place - first.box.center).norm();
    if (reach_m > first.box.length_m + 1) continue;
    const bool in_plot = std::ranges::any_of(farm.plots, [&](const farm::Plot& plot) {
      PlotBox wider = plot.box;
      wider.width_m += 1;
      wider.length_m += 1;
      return wider.contains(place);
    });
    const std::optional<double> ground = farm.terrain.height(place.x(), place.y());
    if (in_plot || !ground) continue;
    const double distance = std::abs(points[i].z() - *ground);
    if (distance < kBare_m) distances.push_back(distance);
  }
  constexpr double kSigmaOfMedian = 1.4826;
  return distances.empty() ? 0 : kSigmaOfMedian * quantile(distances, 0.5);
}

std::map<std::string, double> truth_of(const farm::Plot& plot) {
  const farm::CanopyHeights& canopy = plot.canopy.value();
  return {{"mean", plot.heights.mean}, {"max", plot.heights.max}, {"p50", plot.heights.p50},
          {"p90", plot.heights.p90},   {"p95", plot.heights.p95}, {"p99", plot.heights.p99},
          {"canopy_p95", canopy.p95},  {"canopy_p99", canopy.p99}};
}

// A box as a method would find it: a few centimetres wrong.
PlotBox found_box(const PlotBox& box, std::uint64_t seed, std::size_t number) {
  constexpr double kError_m = 0.02;
  RandomStream random(seed, random_purpose("calibration/box"), number);
  PlotBox found = box;
  found.center.x() += kError_m * random.normal();
  found.center.y() += kError_m * random.normal();
  found.width_m += kError_m * random.normal();
  found.length_m += kError_m * random.normal();
  return found;
}

}  // namespace

FieldSample sample_field(const FarmPlan& plan, const std::filesystem::path& base_farm,
                         GroundSource source, const std::filesystem::path& work, int threads) {
  farm::Farm farm =
      planting::generate(description::load_description(base_farm, plan.overrides), plan.seed);
  lidar::measure_canopies(farm, threads);
  const TemporaryPath scan(work / ("scan-" + std::to_string(plan.seed)));
  lidar::FlyOptions flight = plan.flight;
  flight.threads = threads;
  flight.replace = true;
  lidar::fly(farm, scan.path(), flight);
  const std::vector<Eigen::Vector3f> points = scan::read_positions(scan.path() / "cloud.pcd");
  FieldSample sample{.library = plan.library, .seed = plan.seed};
  sample.surface = source == GroundSource::truth
                       ? true_surface(farm, bare_noise(farm, points))
                       : ground::fit_surface(points, {.threads = threads});
  std::vector<std::vector<Eigen::Vector3f>> perfect = perfect_returns(farm);
  for (std::size_t i = 0; i < farm.plots.size(); ++i) {
    PlotSample plot{.box = found_box(farm.plots[i].box, plan.seed, i),
                    .truth = truth_of(farm.plots[i]),
                    .perfect = std::move(perfect[i])};
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector2d place = point.head<2>().cast<double>();
      if (!plot.box.contains(place)) continue;
      const double ground_m = source == GroundSource::truth
                                  ? farm.terrain.height(place.x(), place.y()).value_or(kNaN)
                                  : sample.surface.height(place);
      if (std::isnan(ground_m)) continue;
      plot.points.emplace_back(point.x(), point.y(), static_cast<float>(point.z() - ground_m));
    }
    sample.plots.push_back(std::move(plot));
  }
  return sample;
}

}  // namespace plotscan::calibration
