// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/extent.h"
#include "core/random.h"
#include "farm/true_heights.h"
#include "planting/internal/plants.h"
#include "planting/plot_layout.h"
#include "terrain/extent.h"

namespace plotscan::planting {
namespace {

constexpr double kMostWeeds = 1e6;

// A rectangle of ground, turned as the plots are.
struct Field {
  Eigen::Rotation2Dd world_from_field = Eigen::Rotation2Dd::Identity();
  Eigen::AlignedBox2d box;

  double area_m2() const { return box.sizes().prod(); }
  Eigen::Vector2d at(const Eigen::Vector2d& share) const {
    return world_from_field * (box.min() + share.cwiseProduct(box.sizes()));
  }
};

// The rectangle about all plots with its margin, turned as the plots of the trial with which it is
// smallest; without plots the one about the terrain.
Field field_of(const std::vector<farm::Plot>& plots, const terrain::Terrain& terrain,
               double margin_m) {
  if (plots.empty()) return {.box = terrain::outline_of(terrain)};
  std::set<double> headings_rad;
  for (const farm::Plot& plot : plots) headings_rad.insert(plot.box.heading_rad);
  std::vector<Field> fields;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  for (const double heading_rad : headings_rad) {
    const Eigen::Rotation2Dd world_from_field(heading_rad);
    const Eigen::AlignedBox2d box = extent_of(plots, &farm::Plot::box, world_from_field.inverse());
    fields.push_back(
        {world_from_field, Eigen::AlignedBox2d(box.min() - margin, box.max() + margin)});
  }
  return *std::ranges::min_element(fields, {}, &Field::area_m2);
}

std::uint64_t number_of_weeds(const WeedsDescription& description, const Field& field,
                              const std::filesystem::path& source) {
  const double weeds = description.per_m2 * field.area_m2();
  if (weeds > kMostWeeds) {
    throw InputError(source,
                     "weeds.per_m2 makes {:.0f} weeds on {:.0f} m2; at most {:.0f} are allowed, "
                     "{:.3g} a square metre, or more with a smaller weeds.margin_m",
                     weeds, field.area_m2(), kMostWeeds, kMostWeeds / field.area_m2());
  }
  return static_cast<std::uint64_t>(std::llround(weeds));
}

bool wanted(WeedPlace where, std::uint32_t plot) {
  if (where == WeedPlace::everywhere) return true;
  return (where == WeedPlace::plots) == (plot != 0);
}

farm::Plant drawn_weed(const WeedsDescription& description, std::uint64_t number,
                       std::uint64_t seed) {
  farm::Plant weed{.kind = farm::PlantKind::weed};
  weed.model = description.models[RandomStream(seed, random_purpose("weed/model"), number)
                                      .below(description.models.size())];
  const double yaw = RandomStream(seed, random_purpose("weed/yaw"), number).uniform(0, 2 * kPi);
  weed.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  RandomStream scale(seed, random_purpose("weed/scale"), number);
  for (int axis = 0; axis < 3; ++axis)
    weed.scale[axis] = scale.uniform(description.min_scale, description.max_scale);
  return weed;
}

}  // namespace

std::vector<farm::Plant> draw_weeds(const WeedsDescription& description,
                                    const std::vector<farm::Plot>& plots,
                                    const std::vector<farm::PlantModel>& models,
                                    const terrain::Terrain& terrain,
                                    const std::filesystem::path& source, std::uint64_t seed) {
  const Field field = field_of(plots, terrain, description.margin_m);
  const PlotFinder finder(plots);
  std::vector<farm::Plant> weeds;
  const std::uint64_t count = number_of_weeds(description, field, source);
  for (std::uint64_t number = 1; number <= count; ++number) {
    RandomStream random(seed, random_purpose("weed/position"), number);
    const double along_x = random.uniform();
    const Eigen::Vector2d place = field.at({along_x, random.uniform()});
    const std::uint32_t plot = finder.plot_at(place);
    const auto ground = terrain.height(place.x(), place.y());
    if (!wanted(description.where, plot) || !ground) continue;
    farm::Plant weed = drawn_weed(description, number, seed);
    weed.plot = plot;
    weed.position = {place.x(), place.y(), *ground};
    weed.height_m = farm::placed_height(models[weed.model], weed, *ground);
    weeds.push_back(weed);
  }
  return weeds;
}

}  // namespace plotscan::planting
