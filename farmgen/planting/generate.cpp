// SPDX-License-Identifier: Apache-2.0
#include "planting/generate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/core.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/stage.h"
#include "core/statistics.h"
#include "farm/true_heights.h"
#include "farmfolder/plot_table.h"
#include "planting/internal/plants.h"
#include "planting/plot_layout.h"
#include "terrain/make_terrain.h"

namespace plotscan::planting {
namespace {

terrain::MadeTerrain made_terrain(const FarmDescription& description,
                                  const std::vector<farm::Plot>& plots, std::uint64_t seed) {
  const Stage stage("terrain");
  return terrain::make_terrain(description.terrain, list_of(plots, &farm::Plot::box), seed,
                               description.source);
}

std::vector<farm::PlantModel> made_models(const FarmDescription& description) {
  Stage stage("plant models");
  std::vector<farm::PlantModel> models = make_models(description.models, description.source);
  stage.found(std::to_string(models.size()) + " models");
  return models;
}

// The trials, each with its heading.
std::vector<TrialDescription> with_headings(std::vector<TrialDescription> trials,
                                            std::uint64_t seed) {
  for (std::size_t place = 0; place < trials.size(); ++place)
    trials[place].plots = turned(std::move(trials[place].plots), seed, place);
  return trials;
}

// The plots of a farm whose plants a table places.
std::vector<farm::Plot> laid_out_plots(const LayoutDescription& layout,
                                       const std::vector<TrialDescription>& trials,
                                       std::uint64_t seed) {
  std::vector<farm::Plot> plots;
  if (layout.plots) plots = farmfolder::read_plot_boxes(*layout.plots);
  for (std::size_t place = 0; place < trials.size(); ++place) {
    const PlotGridDescription& grid = trials[place].plots;
    for (const farm::Plot& plot : grid_plots(grid, trial_number(place, trials.size())))
      if (!is_missing(grid, plot.id, seed)) plots.push_back(plot);
  }
  return plots;
}

// Throws InputError when a trial has none.
void require_plots_left(const FarmDescription& description, const std::vector<farm::Plot>& plots) {
  const std::size_t trials = description.trials.size();
  for (std::size_t place = 0; place < trials; ++place) {
    if (contains(plots, trial_number(place, trials), &farm::Plot::trial)) continue;
    const std::string section = trials > 1 ? "trials." + std::to_string(place) + ".plots" : "plots";
    throw InputError(description.source, "{}: all {} are missing; a lower missing_rate leaves some",
                     section, plots_of(description.trials[place].plots));
  }
}

// Throws InputError when two plots overlap: of two trials, or of a table. (Those of one grid do
// not.)
void require_plots_apart(const FarmDescription& description, const std::vector<farm::Plot>& plots) {
  const bool is_table = description.layout && description.layout->plots;
  if (description.trials.size() < 2 && !is_table) return;
  constexpr double kDrawn = 0.01;  // maps have rounded corners, or were drawn by hand
  const auto pair = is_table ? overlapping_plots(plots, kDrawn) : overlapping_plots(plots);
  if (!pair) return;
  const std::string two = fmt::format("plots {} and {} overlap", pair->first, pair->second);
  if (is_table) throw InputError(*description.layout->plots, two);
  throw InputError(description.source,
                   "trials: {}; another position_m, or another heading_deg, keeps the trials apart",
                   two);
}

std::vector<farm::Plot> planted_plots(const std::vector<SownPlot>& sown) {
  std::vector<farm::Plot> plots;
  for (const SownPlot& plot : sown) {
    plots.push_back(plot.plot);
    plots.back().missing_plants = plot.cultivar->count;  // until they are grown
  }
  return plots;
}

// The weeds come behind the crop, so that no plant of the crop changes its id.
void add_weeds(const FarmDescription& description, farm::Farm& farm) {
  for (farm::Plant& weed : draw_weeds(*description.weeds, farm.plots, farm.models, farm.terrain,
                                      description.source, farm.seed)) {
    weed.id = static_cast<std::uint32_t>(farm.plants.size() + 1);
    farm.plants.push_back(weed);
  }
}

// The crop's plants, and the weeds.
void add_plants(const FarmDescription& description, const std::vector<SownPlot>& sown,
                farm::Farm& farm) {
  Stage stage("plants");
  farm.plants = description.layout
                    ? table_plants(*description.layout, farm.plots, farm.models, farm.terrain)
                    : grow_plants(sown, farm.models, farm.terrain, description.source, farm.seed);
  if (description.weeds) add_weeds(description, farm);
  stage.found(std::to_string(farm.plants.size()) + " plants");
}

// How far the plant's stem leans from the vertical.
double lean_of(const farm::Plant& plant) {
  return 2 * std::asin(std::min(1.0, std::hypot(plant.rotation.x(), plant.rotation.y())));
}

// What grows in a plot: its crop, plant by plant, and how many weeds.
struct Stand {
  std::vector<double> heights_m, leans_rad;
  std::uint32_t weeds = 0;
};

// Counts, heights and leans of each plot's plants; of the weeds, the count.
void measure_plots(farm::Farm& farm) {
  std::unordered_map<std::uint32_t, Stand> stands;
  for (const farm::Plant& plant : farm.plants) {
    Stand& stand = stands[plant.plot];
    if (plant.kind == farm::PlantKind::weed) {
      ++stand.weeds;
    } else {
      stand.heights_m.push_back(plant.height_m);
      stand.leans_rad.push_back(lean_of(plant));
    }
  }
  for (farm::Plot& plot : farm.plots) {
    const Stand& stand = stands[plot.id];
    plot.plant_count = static_cast<std::uint32_t>(stand.heights_m.size());
    plot.heights = farm::plot_heights(stand.heights_m, farm.seed, plot.id);
    plot.missing_plants -= std::min(plot.missing_plants, plot.plant_count);
    plot.weed_count = stand.weeds;
    if (plot.plant_count > 0) plot.lodging_rad = mean(stand.leans_rad);
  }
}

}  // namespace

farm::Farm generate(const FarmDescription& description, std::uint64_t seed) {
  const std::vector<TrialDescription> trials = with_headings(description.trials, seed);
  std::vector<SownPlot> sown;
  if (!description.layout) sown = sow(trials, seed);
  std::vector<farm::Plot> plots =
      description.layout ? laid_out_plots(*description.layout, trials, seed) : planted_plots(sown);
  require_plots_left(description, plots);
  require_plots_apart(description, plots);
  terrain::MadeTerrain ground = made_terrain(description, plots, seed);
  farm::Farm farm{.name = description.name,
                  .seed = seed,
                  .terrain = std::move(ground.terrain),
                  .models = made_models(description),
                  .plots = std::move(plots),
                  .plants = {},
                  .anchor = description.anchor,
                  .terrain_origin_m = ground.origin_m,
                  .soil_reflectance = description.terrain.reflectance};
  require_on_terrain(farm.plots, farm.terrain, description.source);
  add_plants(description, sown, farm);
  measure_plots(farm);
  return farm;
}

}  // namespace plotscan::planting
