// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <tuple>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/trial_layout.h"
#include "core/yaml_section.h"
#include "description/internal/sections.h"
#include "description/internal/shared_keys.h"
#include "planting/plot_layout.h"

namespace plotscan::description {
namespace {

constexpr Range kPlantShare = {0, 1};
constexpr Range kLean = {0, 90};
constexpr std::int64_t kMostPlantsPerPlot = 1'000'000;
constexpr std::size_t kMostCultivars = 10'000;

// A cultivar's section; keys that it lacks are taken from `plants`.
class Inherited {
 public:
  Inherited(const YamlSection& own, const YamlSection& plants) : own_(own), plants_(plants) {}
  // The section that has the key, the cultivar's own where neither has.
  const YamlSection& at(const std::string& key) const {
    return !has_own(key) && plants_.has(key) ? plants_ : own_;
  }
  bool has(const std::string& key) const { return has_own(key) || plants_.has(key); }
  // Whether the cultivar's own section has the key, which `plants` may have in any case.
  bool has_own(const std::string& key) const {
    plants_.has(key);
    return own_.has(key);
  }
  const YamlSection& own() const { return own_; }

 private:
  const YamlSection& own_;
  const YamlSection& plants_;
};

std::uint32_t read_count(const Inherited& section, const planting::PlotGridDescription& grid) {
  const YamlSection& own = section.own();
  const bool counts = section.has_own("count");
  const bool is_dense = section.has_own("density_m2");
  const YamlSection& where =
      counts || is_dense ? own : section.at(section.has("count") ? "count" : "density_m2");
  if (where.has("count") && where.has("density_m2"))
    where.fail("density_m2", "is given beside count; give one of the two");
  if (!where.has("density_m2"))
    return static_cast<std::uint32_t>(where.integer("count", 0, kMostPlantsPerPlot));
  const double plants = where.number("density_m2", {0, 10000}) * grid.width_m * grid.length_m;
  if (plants > static_cast<double>(kMostPlantsPerPlot))
    where.fail("density_m2", "makes more than 1000000 plants a plot");
  return static_cast<std::uint32_t>(std::llround(plants));
}

void read_pattern(const Inherited& section, planting::CultivarDescription& cultivar) {
  if (section.at("pattern").choice("pattern", {"random", "drilled"}, 0) == 1) {
    cultivar.pattern = planting::PlantPattern::drilled;
    cultivar.drill_rows =
        static_cast<std::uint32_t>(section.at("drill_rows").integer("drill_rows", 1, 10'000));
    cultivar.jitter_m = section.at("jitter_m").number("jitter_m", {0, 10}, 0.0);
    cultivar.yaw_of_row = section.at("yaw").choice("yaw", {"random", "row"}, 0) == 1;
  }
  for (const char* key : {"drill_rows", "jitter_m", "yaw"})
    if (section.has_own(key) && cultivar.pattern == planting::PlantPattern::random)
      section.own().fail(key, "belongs to pattern: drilled; the pattern is random");
}

planting::HeightDescription read_height(const YamlSection& section) {
  const planting::HeightDescription height{.mean_m = section.number("mean", {0.01, 20}),
                                           .sd_m = section.number("sd", {0, 10})};
  if (height.sd_m > 0.3 * height.mean_m)
    section.fail("sd", "is more than 0.3 of the mean; plants without height would be drawn");
  return height;
}

planting::MissingDescription read_missing(const YamlSection& section,
                                          const planting::PlotGridDescription& grid) {
  const planting::MissingDescription missing{
      .rate = section.number("rate", kPlantShare, 0.0),
      .gaps_per_plot = section.number("gaps_per_plot", {0, 100}, 0.0),
      .gap_length_m = section.number("gap_length_m", {0, 1000}, 0.0)};
  if (missing.gap_length_m > grid.length_m)
    section.fail("gap_length_m", "is longer than the plots");
  if (missing.gaps_per_plot > 0 && missing.gap_length_m == 0)
    section.fail("gap_length_m", "has to be above 0 where there are gaps");
  return missing;
}

planting::LodgingDescription read_lodging(const YamlSection& section) {
  const auto [least, greatest] = section.pair("angle_deg", kLean);
  if (least > greatest) section.fail("angle_deg", "is not [min, max]: min is the larger");
  planting::LodgingDescription lodging{
      .plots_rate = section.number("plots_rate", kPlantShare),
      .min_angle_rad = least * kDegrees,
      .max_angle_rad = greatest * kDegrees,
      .spread_rad = section.number("spread_deg", kLean, 10.0) * kDegrees};
  if (section.has("direction_deg"))
    lodging.direction_rad = section.number("direction_deg", {-360, 360}) * kDegrees;
  return lodging;
}

planting::CultivarDescription read_cultivar(const Inherited& section,
                                            const planting::PlotGridDescription& grid,
                                            std::vector<planting::ModelDescription>& models) {
  planting::CultivarDescription cultivar{.name = std::string(farm::kNoAccession)};
  cultivar.count = read_count(section, grid);
  read_pattern(section, cultivar);
  std::tie(cultivar.min_scale, cultivar.max_scale) = scale_at(section.at("scale"));
  if (section.has("height_m"))
    cultivar.height = read_height(section.at("height_m").section("height_m"));
  if (section.has("missing"))
    cultivar.missing = read_missing(section.at("missing").section("missing"), grid);
  if (section.has("lodging"))
    cultivar.lodging = read_lodging(section.at("lodging").section("lodging"));
  cultivar.models = read_models(section.at("models"), models);
  return cultivar;
}

void read_cultivars(const YamlSection& section, const planting::PlotGridDescription& grid,
                    planting::PlantsDescription& plants,
                    std::vector<planting::ModelDescription>& models) {
  std::size_t with_own_models = 0;
  for (const YamlSection& entry : section.list("cultivars", kMostCultivars)) {
    const std::string name = name_at(entry, "name");
    for (const planting::CultivarDescription& other : plants.cultivars)
      if (other.name == name) entry.fail("name", "\"{}\" is another cultivar's too", name);
    plants.cultivars.push_back(read_cultivar({entry, section}, grid, models));
    plants.cultivars.back().name = name;
    with_own_models += entry.has("models") ? 1 : 0;
  }
  if (section.has("models") && with_own_models == plants.cultivars.size())
    section.fail("models", "are not used: every cultivar has its own");
}

void read_list(const YamlSection& section, planting::PlantsDescription& plants) {
  const auto names = list_of(plants.cultivars, &planting::CultivarDescription::name);
  for (const YamlSection& entry : section.list("list", kMostPlots, "cultivar"))
    plants.design.list.push_back(entry.choice("cultivar", names));
}

// `reps`, where it is given, has to be what the plots make.
void require_replicates(const YamlSection& section, const planting::PlotGridDescription& grid,
                        std::size_t cultivars) {
  const auto reps = static_cast<std::uint64_t>(section.integer("reps", 1, kMostPlots));
  if (reps * cultivars == planting::plots_of(grid)) return;
  section.fail("reps", "{} of {} cultivars are {} plots; the grid has {}", reps, cultivars,
               reps * cultivars, planting::plots_of(grid));
}

void read_design(const YamlSection& section, const planting::PlotGridDescription& grid,
                 planting::PlantsDescription& plants) {
  planting::DesignDescription& design = plants.design;
  design.design = static_cast<planting::TrialDesign>(
      section.choice("design", {"rcbd", "random", "cycle", "list"}, 0));
  design.block_by =
      static_cast<planting::BlockBy>(section.choice("block_by", {"plots", "rows", "columns"}, 0));
  if (section.has("block_by") && design.design != planting::TrialDesign::rcbd)
    section.fail("block_by", "belongs to design: rcbd");
  if (section.has("list") != (design.design == planting::TrialDesign::list))
    section.fail("list", "and design: list belong together");
  if (design.design == planting::TrialDesign::list) read_list(section, plants);
  if (section.has("reps")) require_replicates(section, grid, plants.cultivars.size());
  std::vector<std::string> names(plants.cultivars.size());
  std::vector<farm::Plot> plots = planting::grid_plots(grid);
  std::vector<std::size_t> assigned;
  try {
    assigned = planting::assign_cultivars(design, names, 0, plots);
  } catch (const InputError& error) {
    section.fail("design", error.what());
  }
  std::vector<bool> sown(plants.cultivars.size(), false);
  for (const std::size_t cultivar : assigned) sown[cultivar] = true;
  for (std::size_t i = 0; i < sown.size(); ++i) {
    if (sown[i]) continue;
    section.fail("cultivars", "leave \"{}\" without a plot", plants.cultivars[i].name);
  }
}

void require_countable(const YamlSection& section, const planting::PlotGridDescription& grid,
                       const planting::PlantsDescription& plants) {
  const std::uint64_t total = planting::most_seeds(grid, plants);
  if (total <= kMostSeedsOfFarm) return;
  section.fail(section.has("cultivars")    ? "cultivars"
               : section.has("density_m2") ? "density_m2"
                                           : "count",
               "makes {} plants in {} plots; at most {} are allowed", total,
               planting::plots_of(grid), kMostSeedsOfFarm);
}

}  // namespace

planting::PlantsDescription read_plants(const YamlSection& section,
                                        const planting::PlotGridDescription& grid,
                                        std::vector<planting::ModelDescription>& models) {
  planting::PlantsDescription plants;
  if (section.has("cultivars")) {
    read_cultivars(section, grid, plants, models);
    read_design(section, grid, plants);
  } else {
    plants.cultivars.push_back(read_cultivar({section, section}, grid, models));
    plants.design.design = planting::TrialDesign::cycle;
  }
  require_countable(section, grid, plants);
  return plants;
}

}  // namespace plotscan::description
