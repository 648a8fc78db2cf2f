// SPDX-License-Identifier: Apache-2.0
#include "heights/measure_heights.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/each_index.h"
#include "core/list_of.h"
#include "heights/features.h"
#include "heights/flags.h"
#include "heights/internal/box_cells.h"
#include "heights/internal/calibration_files.h"
#include "heights/internal/own_part.h"
#include "heights/internal/plant_heights.h"
#include "heights/known_returns.h"

namespace plotscan::heights {
namespace {

constexpr double kScannedCell_m = 0.5;

// What a plot's returns show.
struct SeenPlot {
  PlotCanopy own;    // in the part that holds its own plants
  PlotCanopy whole;  // in the box: only its quantiles count
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

// The canopy over that box, and the ground under it.
struct SeenPart {
  PlotCanopy canopy;
  PlotGround ground;
};

SeenPart see(const PlotBox& box, std::span<const Eigen::Vector3f> points,
             const ground::Surface& surface) {
  const KnownReturns known = known_returns(box, points, surface);
  const SeenCanopy canopy = see_canopy(box, known.points, surface.noise_m, known.ground.slope);
  SeenPart part{.canopy = {.top_m = canopy.features.top_m,
                           .features = canopy.features.values,
                           .ground_error_m = known.ground.standard_error_m},
                .ground = known.ground};
  for (const auto& [name, quantile] : canopy_quantiles()) {
    part.canopy.quantiles_m[name] = canopy.profile.quantile(quantile.area_share);
    part.canopy.sampling_m[name] = sampling_error_m(canopy.profile, quantile.area_share);
  }
  return part;
}

SeenPlot see_plot(const PlotPoints& plot, const OwnPart& own, const ground::Surface& surface) {
  const SeenPart whole = see(plot.box, plot.points, surface);
  SeenPlot seen{.own = whole.canopy,
                .whole = whole.canopy,
                .evidence = {.returns = plot.points.size(),
                             .area_m2 = plot.box.area_m2(),
                             .scanned_share = scanned_share(plot),
                             .noise_m = surface.noise_m,
                             .ground = whole.ground,
                             .reached = own.reached}};
  if (own.reached) {
    const auto inside = those_of(plot.points, [&](const Eigen::Vector3f& point) {
      return own.box.contains(point.head<2>().cast<double>());
    });
    seen.own = see(own.box, inside, surface).canopy;
  }
  seen.evidence.top_m = seen.own.top_m;
  seen.own.bare = is_bare(seen.evidence);
  return seen;
}

std::vector<SeenPlot> see_all(std::span<const PlotPoints> plots, const ground::Surface& surface,
                              int threads) {
  const std::vector<OwnPart> own = own_parts(plots, threads);
  std::vector<SeenPlot> seen(plots.size());
  for_each_index(plots.size(), threads, [&](std::size_t i) {
    if (!plots[i].points.empty()) seen[i] = see_plot(plots[i], own[i], surface);
  });
  return seen;
}

const CalibratedModels& shipped_models() {
  static const CalibratedModels models(shipped_calibration());
  return models;
}

// That height of the whole box's canopy: as much over the own part's as its quantile is. Where
// canopies of two heights meet, few returns lie about the quantile.
Height over_whole(const Height& own, const std::string& name, const SeenPlot& plot) {
  const double above_m = plot.whole.quantiles_m.at(name) - plot.own.quantiles_m.at(name);
  return height_of(own.value_m + above_m,
                   std::hypot(own.standard_error_m, plot.whole.sampling_m.at(name)));
}

// Heights of the plants are those of the plots' own; the canopy's are those of what hangs over
// the box, whichever plot it stands in.
FieldPlants heights_of(const std::vector<SeenPlot>& seen, const HeightOptions& options) {
  const std::vector<PlotCanopy> own = list_of(seen, &SeenPlot::own);
  FieldPlants plants = options.calibrated ? calibrated_heights(own, shipped_models(), options.crop)
                                          : quantile_heights(own);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i].evidence.reached) continue;
    for (auto& [name, height] : plants.plots[i].heights)
      if (name.starts_with("canopy_")) height = over_whole(height, name, seen[i]);
  }
  return plants;
}

}  // namespace

const std::vector<std::string>& crop_names() {
  static const std::vector<std::string> names = nlohmann::json::parse(calibration_file("crops"));
  return names;
}

FieldHeights measure_heights(std::span<const PlotPoints> plots, const ground::Surface& surface,
                             const HeightOptions& options) {
  const std::vector<SeenPlot> all = see_all(plots, surface, options.threads);
  std::vector<std::size_t> measured;
  std::vector<SeenPlot> seen;
  FieldHeights field{.plots = std::vector<PlotHeights>(plots.size())};
  for (std::size_t i = 0; i < plots.size(); ++i) {
    field.plots[i] = {.flags = flags_of(all[i].evidence, {}), .points = plots[i].points.size()};
    if (plots[i].points.empty()) continue;
    measured.push_back(i);
    seen.push_back(all[i]);
  }
  FieldPlants plants = heights_of(seen, options);
  field.crops = std::move(plants.crops);
  for (std::size_t k = 0; k < measured.size(); ++k) {
    PlotHeights& plot = field.plots[measured[k]];
    seen[k].evidence.novelty = plants.plots[k].novelty;
    plot.heights = std::move(plants.plots[k].heights);
    plot.flags = flags_of(seen[k].evidence, plot.heights);
  }
  return field;
}

}  // namespace plotscan::heights
