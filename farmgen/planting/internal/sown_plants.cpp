// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/random.h"
#include "farm/true_heights.h"
#include "planting/internal/plants.h"
#include "planting/plot_layout.h"

namespace plotscan::planting {
namespace {

// Heights further from the mean than this many standard deviations are drawn again.
constexpr double kFarthestHeight = 3;

// A stretch along the length without plants: over the whole width, or of one drilled row.
struct Gap {
  double begin_m = 0;  // from the plot's centre
  double end_m = 0;
  std::uint32_t row = 0;
};

// How a plot's plants lean; absent where they stand.
struct Lodging {
  double angle_rad = 0;
  double direction_rad = 0;
  double spread_rad = 0;
};

// How many of rare, independent events happen (Knuth, TAOCP 2, 3.4.1).
std::uint32_t poisson(double mean, RandomStream& random) {
  const double limit = std::exp(-mean);
  std::uint32_t events = 0;
  double product = random.uniform();
  while (product > limit) {
    ++events;
    product *= random.uniform();
  }
  return events;
}

std::vector<Gap> drawn_gaps(const SownPlot& sown, std::uint64_t seed) {
  const MissingDescription& missing = sown.cultivar->missing;
  RandomStream random(seed, random_purpose("plot/gaps"), sown.plot.id);
  std::vector<Gap> gaps(poisson(missing.gaps_per_plot, random));
  for (Gap& gap : gaps) {
    gap.begin_m = random.uniform() * (sown.plot.box.length_m - missing.gap_length_m) -
                  sown.plot.box.length_m / 2;
    gap.end_m = gap.begin_m + missing.gap_length_m;
    gap.row = static_cast<std::uint32_t>(random.below(sown.cultivar->drill_rows));
  }
  return gaps;
}

std::optional<Lodging> drawn_lodging(const SownPlot& sown, std::uint64_t seed) {
  if (!sown.cultivar->lodging) return {};
  const LodgingDescription& lodging = *sown.cultivar->lodging;
  RandomStream random(seed, random_purpose("plot/lodging"), sown.plot.id);
  if (random.uniform() >= lodging.plots_rate) return {};
  const double angle = random.uniform(lodging.min_angle_rad, lodging.max_angle_rad);
  return Lodging{.angle_rad = angle,
                 .direction_rad = lodging.direction_rad.value_or(random.uniform(0, 2 * kPi)),
                 .spread_rad = lodging.spread_rad};
}

// The plants of one plot. Places are (along length, along width) from the plot's centre.
class PlotPlants {
 public:
  PlotPlants(const SownPlot& sown, const std::vector<farm::PlantModel>& models,
             const terrain::Terrain& terrain, const std::filesystem::path& source,
             std::uint64_t seed)
      : plot_(sown.plot),
        cultivar_(*sown.cultivar),
        first_seed_(sown.first_seed),
        models_(models),
        terrain_(terrain),
        source_(source),
        seed_(seed),
        gaps_(drawn_gaps(sown, seed)),
        lodging_(drawn_lodging(sown, seed)) {}

  void put_into(std::vector<farm::Plant>& plants) const {
    for (std::uint32_t index = 0; index < cultivar_.count; ++index) {
      const std::uint64_t number = first_seed_ + index;
      const Eigen::Vector2d place = place_of(index, number);
      if (is_missing(index, number, place)) continue;
      farm::Plant plant = drawn_plant(number);
      plant.id = static_cast<std::uint32_t>(plants.size() + 1);
      plant.plot = plot_.id;
      stand(plant, place);
      plants.push_back(plant);
    }
  }

 private:
  RandomStream stream(std::string_view what, std::uint64_t number) const {
    return {seed_, random_purpose(what), number};
  }

  Eigen::Vector2d place_of(std::uint32_t index, std::uint64_t number) const {
    return cultivar_.pattern == PlantPattern::drilled ? drilled_place(index, number)
                                                      : random_place(number);
  }

  Eigen::Vector2d random_place(std::uint64_t number) const {
    RandomStream random = stream("plant/position", number);
    const double along_length = random.uniform(-0.5, 0.5) * plot_.box.length_m;
    return {along_length, random.uniform(-0.5, 0.5) * plot_.box.width_m};
  }

  // Plants fill the rows evenly (the first rows take what is left over), each row's plants evenly
  // spaced; the jitter keeps them inside the box.
  Eigen::Vector2d drilled_place(std::uint32_t index, std::uint64_t number) const {
    const std::uint32_t rows = cultivar_.drill_rows;
    const std::uint32_t row = index % rows;
    const std::uint32_t in_row = (cultivar_.count - row + rows - 1) / rows;
    const std::uint32_t place_in_row = index / rows;
    const Eigen::Vector2d even(((place_in_row + 0.5) / in_row - 0.5) * plot_.box.length_m,
                               ((row + 0.5) / rows - 0.5) * plot_.box.width_m);
    RandomStream random = stream("plant/jitter", number);
    const double along_length = random.uniform(-cultivar_.jitter_m, cultivar_.jitter_m);
    const double along_width = random.uniform(-cultivar_.jitter_m, cultivar_.jitter_m);
    const Eigen::Vector2d half(plot_.box.length_m / 2, plot_.box.width_m / 2);
    return (even + Eigen::Vector2d(along_length, along_width)).cwiseMax(-half).cwiseMin(half);
  }

  bool is_missing(std::uint32_t index, std::uint64_t number, const Eigen::Vector2d& place) const {
    if (stream("plant/emergence", number).uniform() < cultivar_.missing.rate) return true;
    return std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
      const bool same_row =
          cultivar_.pattern == PlantPattern::random || index % cultivar_.drill_rows == gap.row;
      return same_row && place.x() >= gap.begin_m && place.x() <= gap.end_m;
    });
  }

  farm::Plant drawn_plant(std::uint64_t number) const {
    farm::Plant plant;
    plant.model = cultivar_.models[stream("plant/model", number).below(cultivar_.models.size())];
    const double turn = stream("plant/yaw", number).uniform(0, 2 * kPi);
    const double yaw = cultivar_.yaw_of_row ? plot_.box.heading_rad + (turn < kPi ? 0 : kPi) : turn;
    plant.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
    if (lodging_) plant.rotation = lean_of(number) * plant.rotation;
    RandomStream scale = stream("plant/scale", number);
    for (int axis = 0; axis < 3; ++axis)
      plant.scale[axis] = scale.uniform(cultivar_.min_scale, cultivar_.max_scale);
    if (cultivar_.height) plant.scale.z() = scale_to_height(models_[plant.model], number);
    return plant;
  }

  double scale_to_height(const farm::PlantModel& model, std::uint64_t number) const {
    RandomStream random = stream("plant/height", number);
    double deviations = random.normal();
    while (std::abs(deviations) > kFarthestHeight) deviations = random.normal();
    const double height_m = cultivar_.height->mean_m + deviations * cultivar_.height->sd_m;
    const double scale = height_m / model.height_m;
    if (kPlantScale.contains(scale)) return scale;
    throw InputError(source_,
                     "plants.height_m: a plant of {} is to be {:.3f} m high, but its model {} is "
                     "{:.3f} m high; its scale has to be in {}",
                     cultivar_.name, height_m, model.name, model.height_m, kPlantScale.text());
  }

  // What tilts an upright plant of a lodged plot.
  Eigen::Quaterniond lean_of(std::uint64_t number) const {
    RandomStream random = stream("plant/lodging", number);
    const double spread = lodging_->spread_rad;
    const double angle =
        std::clamp(lodging_->angle_rad + random.uniform(-spread, spread), 0.0, kPi / 2);
    const double direction = lodging_->direction_rad + random.uniform(-spread, spread);
    const Eigen::Vector3d axis(-std::sin(direction), std::cos(direction), 0);
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  }

  void stand(farm::Plant& plant, const Eigen::Vector2d& place) const {
    const Eigen::Vector2d world =
        plot_.box.center + place.x() * plot_.box.length_axis() + place.y() * plot_.box.width_axis();
    const auto ground = terrain_.height(world.x(), world.y());
    if (!ground)
      throw InputError(source_, "plots: plot {} lies over a hole of the terrain", plot_.id);
    plant.position = {world.x(), world.y(), *ground};
    plant.height_m = farm::placed_height(models_[plant.model], plant, *ground);
  }

  const farm::Plot& plot_;
  const CultivarDescription& cultivar_;
  std::uint64_t first_seed_;
  const std::vector<farm::PlantModel>& models_;
  const terrain::Terrain& terrain_;
  const std::filesystem::path& source_;
  std::uint64_t seed_;
  std::vector<Gap> gaps_;
  std::optional<Lodging> lodging_;
};

}  // namespace

std::vector<SownPlot> sow(const std::vector<TrialDescription>& trials, std::uint64_t seed) {
  std::vector<SownPlot> sown;
  std::uint64_t next_seed = 1;
  for (std::size_t place = 0; place < trials.size(); ++place) {
    const std::vector<CultivarDescription>& cultivars = trials[place].plants.value().cultivars;
    const auto accessions = list_of(cultivars, &CultivarDescription::name);
    const PlotGridDescription& grid = trials[place].plots;
    std::vector<farm::Plot> plots = grid_plots(grid, trial_number(place, trials.size()));
    const std::vector<std::size_t> assigned = assign_cultivars(
        trials[place].plants->design, accessions, seed, plots, static_cast<std::uint32_t>(place));
    for (std::size_t i = 0; i < plots.size(); ++i) {
      const CultivarDescription& cultivar = cultivars[assigned[i]];
      if (!is_missing(grid, plots[i].id, seed)) sown.push_back({plots[i], &cultivar, next_seed});
      next_seed += cultivar.count;
    }
  }
  return sown;
}

std::vector<farm::Plant> grow_plants(const std::vector<SownPlot>& plots,
                                     const std::vector<farm::PlantModel>& models,
                                     const terrain::Terrain& terrain,
                                     const std::filesystem::path& source, std::uint64_t seed) {
  std::size_t seeds = 0;
  for (const SownPlot& plot : plots) seeds += plot.cultivar->count;
  std::vector<farm::Plant> plants;
  plants.reserve(seeds);
  for (const SownPlot& plot : plots)
    PlotPlants(plot, models, terrain, source, seed).put_into(plants);
  return plants;
}

}  // namespace plotscan::planting
