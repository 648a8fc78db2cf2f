// SPDX-License-Identifier: Apache-2.0
#include "heights/measure_heights.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/each_index.h"
#include "heights/features.h"
#include "heights/flags.h"
#include "heights/internal/box_cells.h"
#include "heights/internal/calibration_files.h"
#include "heights/internal/plant_heights.h"
#include "heights/known_returns.h"

namespace plotscan::heights {
namespace {

constexpr double kScannedCell_m = 0.5;

struct SeenPlot {
  PlotCanopy canopy;
  PlotEvidence evidence;
};

double scanned_share(const PlotPoints& plot) {
  const BoxCells cells(plot.box, kScannedCell_m);
  std::vector<bool> scanned(cells.count(), false);
  for (const Eigen::Vector3f& point : plot.points) scanned[cells.index(point)] = true;
  return static_cast<double>(std::ranges::count(scanned, true)) /
         static_cast<double>(cells.count());
}

// Standard error of a quantile of the returns' heights, were they drawn at random: half of what
// lies between the quantiles one standard error of the share below and above (Woodruff 1952).
double sampling_error_m(const HeightProfile& profile, double area_share) {
  const double returns = std::max<double>(1, static_cast<double>(profile.returns));
  const double share_sd = std::sqrt(area_share * (1 - area_share) / returns);
  return (profile.quantile(std::min(1.0, area_share + share_sd)) -
          profile.quantile(std::max(0.0, area_share - share_sd))) /
         2;
}

SeenPlot see(const PlotPoints& plot, const ground::Surface& surface) {
  const double noise_m = surface.noise_m;
  const KnownReturns known = known_returns(plot.box, plot.points, surface);
  const SeenCanopy canopy = see_canopy(plot.box, known.points, noise_m, known.ground.slope);
  SeenPlot seen{.canopy = {.top_m = canopy.features.top_m, .features = canopy.features.values},
                .evidence = {.returns = plot.points.size(),
                             .area_m2 = plot.box.area_m2(),
                             .scanned_share = scanned_share(plot),
                             .top_m = canopy.features.top_m,
                             .noise_m = noise_m,
                             .ground = known.ground}};
  seen.canopy.bare = is_bare(seen.evidence);
  seen.canopy.ground_error_m = known.ground.standard_error_m;
  for (const auto& [name, quantile] : canopy_quantiles()) {
    seen.canopy.quantiles_m[name] = canopy.profile.quantile(quantile.area_share);
    seen.canopy.sampling_m[name] = sampling_error_m(canopy.profile, quantile.area_share);
  }
  return seen;
}

std::vector<SeenPlot> see_all(std::span<const PlotPoints> plots, const ground::Surface& surface,
                              int threads) {
  std::vector<SeenPlot> seen(plots.size());
  for_each_index(plots.size(), threads, [&](std::size_t i) {
    if (!plots[i].points.empty()) seen[i] = see(plots[i], surface);
  });
  return seen;
}

const CalibratedModels& shipped_models() {
  static const CalibratedModels models(shipped_calibration());
  return models;
}

}  // namespace

const std::vector<std::string>& crop_names() {
  static const std::vector<std::string> names = nlohmann::json::parse(calibration_file("crops"));
  return names;
}

FieldHeights measure_heights(std::span<const PlotPoints> plots, const ground::Surface& surface,
                             const HeightOptions& options) {
  std::vector<SeenPlot> seen = see_all(plots, surface, options.threads);
  std::vector<std::size_t> measured;
  std::vector<PlotCanopy> field;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    if (plots[i].points.empty()) continue;
    measured.push_back(i);
    field.push_back(seen[i].canopy);
  }
  const FieldPlants plants = options.calibrated
                                 ? calibrated_heights(field, shipped_models(), options.crop)
                                 : quantile_heights(field);
  FieldHeights field_heights{.plots = std::vector<PlotHeights>(plots.size()),
                             .crops = plants.crops};
  for (std::size_t k = 0; k < measured.size(); ++k) {
    field_heights.plots[measured[k]].heights = plants.plots[k].heights;
    seen[measured[k]].evidence.novelty = plants.plots[k].novelty;
  }
  for (std::size_t i = 0; i < plots.size(); ++i) {
    field_heights.plots[i].points = plots[i].points.size();
    field_heights.plots[i].flags = flags_of(seen[i].evidence, field_heights.plots[i].heights);
  }
  return field_heights;
}

}  // namespace plotscan::heights
