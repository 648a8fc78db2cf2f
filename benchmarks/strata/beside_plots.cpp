// SPDX-License-Identifier: Apache-2.0
#include "strata/beside_plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.h"
#include "core/statistics.h"
#include "strata/random_draws.h"

namespace plotscan::strata {
namespace {

using Things = std::vector<Thing>;

// A side of the field, and the way out of it.
struct FieldSide {
  Eigen::Vector2d middle, outwards;
  double length_m = 0;
  double heading_rad = 0;  // along the side
};

FieldSide draw_side(const PlotBox& field, RandomStream& random) {
  const double sign = chance(random, 0.5) ? 0.5 : -0.5;
  if (chance(random, 0.5)) {
    return {field.center + sign * field.width_m * field.width_axis(), 2 * sign * field.width_axis(),
            field.length_m, field.heading_rad};
  }
  return {field.center + sign * field.length_m * field.length_axis(),
          2 * sign * field.length_axis(), field.width_m, field.heading_rad + kPi / 2};
}

struct Size {
  Bounds width_m, length_m, height_m;
};

// A thing beside the field, along the side or turned.
Thing place_thing(Shape shape, const Size& size, const FieldSide& side, RandomStream& random) {
  Thing thing{.shape = shape, .outline = {}, .height_m = draw(random, size.height_m)};
  thing.cover = shape == Shape::crown || shape == Shape::hedge ? random.uniform(0.6, 0.95) : 1;
  PlotBox& box = thing.outline;
  box.width_m = draw(random, size.width_m);
  box.length_m = std::max(box.width_m, draw(random, size.length_m));
  const bool along = chance(random, 0.6);
  const double reach_m = along ? box.width_m / 2 : std::hypot(box.width_m, box.length_m) / 2;
  const double from_middle_m = random.uniform(-0.5, 0.5) * side.length_m;
  const Eigen::Vector2d along_side{std::cos(side.heading_rad), std::sin(side.heading_rad)};
  box.center =
      side.middle + from_middle_m * along_side + (random.uniform(1, 4) + reach_m) * side.outwards;
  box.heading_rad = along ? side.heading_rad : random.uniform(0, kPi);
  return thing;
}

// Single plants about a place.
Things patch_of_weeds(const FieldSide& side, RandomStream& random) {
  constexpr double kWidest_m = 0.7;
  const Size patch{{1, 3}, {1, 4}, {0.2, 0.8}};
  const Thing area = place_thing(Shape::crown, patch, side, random);
  Things weeds(static_cast<std::size_t>(draw_count(random, 5, 20)), area);
  for (Thing& weed : weeds) {
    PlotBox& box = weed.outline;
    const double reach_m = kWidest_m / 2;
    const double along_m = random.uniform(-1, 1) * (box.length_m / 2 - reach_m);
    const double across_m = random.uniform(-1, 1) * (box.width_m / 2 - reach_m);
    box.center += along_m * box.length_axis() + across_m * box.width_axis();
    box.width_m = box.length_m = random.uniform(0.2, kWidest_m);
    weed.height_m *= random.uniform(0.5, 1);
  }
  return weeds;
}

Things draw_object(const FieldSide& side, RandomStream& random) {
  struct Kind {
    Shape shape;
    Size size;
  };
  static const std::array kinds = {
      Kind{Shape::crown, {{2, 5}, {2, 5}, {3, 6}}},             // a tree
      Kind{Shape::hedge, {{0.8, 1.5}, {5, 20}, {1.2, 2.5}}},    // a hedge
      Kind{Shape::hedge, {{0.8, 1.6}, {5, 25}, {0.4, 0.8}}},    // a windrow
      Kind{Shape::car, {{1.65, 1.95}, {3.7, 5}, {1.4, 1.9}}},   // a car
      Kind{Shape::roof, {{2.5, 4}, {3, 6}, {2.2, 3.5}}},        // a shed
      Kind{Shape::block, {{0.4, 0.6}, {0.4, 0.6}, {1.6, 1.9}}}  // a person
  };
  const std::size_t which = random.below(kinds.size() + 1);
  if (which == kinds.size()) return patch_of_weeds(side, random);
  return {place_thing(kinds[which].shape, kinds[which].size, side, random)};
}

Things draw_objects(const PlotBox& field, RandomStream& random) {
  Things things;
  for (int count = draw_count(random, 1, 3); count > 0; --count) {
    const Things more = draw_object(draw_side(field, random), random);
    things.insert(things.end(), more.begin(), more.end());
  }
  return things;
}

// As high as the plots, or a third lower or higher.
Thing draw_border(std::span<const farm::Plot> plots, const PlotBox& field, RandomStream& random) {
  constexpr double kBeyond_m = 100;  // past any cloud's edge
  std::vector<double> tops_m;
  for (const farm::Plot& plot : plots) tops_m.push_back(plot.heights.p50);
  const FieldSide side = draw_side(field, random);
  const double gap_m = random.uniform(0.5, 3);
  return {.shape = Shape::canopy,
          .outline = {.center = side.middle + (gap_m + kBeyond_m / 2) * side.outwards,
                      .width_m = kBeyond_m,
                      .length_m = side.length_m + kBeyond_m,
                      .heading_rad = side.heading_rad},
          .height_m = quantile(tops_m, 0.5) * random.uniform(0.67, 1.33),
          .cover = random.uniform(0.85, 1)};
}

}  // namespace

PlotBox rectangle_about(std::span<const farm::Plot> plots) {
  const PlotBox& first = plots.front().box;
  Eigen::AlignedBox2d bounds;
  for (const farm::Plot& plot : plots)
    for (const Eigen::Vector2d& corner : plot.box.corners())
      bounds.extend(first.box_from_world(corner));
  const Eigen::Vector2d middle = bounds.center();
  return {
      .center = first.center + middle.x() * first.length_axis() + middle.y() * first.width_axis(),
      .width_m = bounds.sizes().y(),
      .length_m = bounds.sizes().x(),
      .heading_rad = first.heading_rad};
}

std::vector<Thing> draw_beside(Beside beside, std::span<const farm::Plot> plots,
                               RandomStream& random) {
  if (beside == Beside::nothing) return {};
  const PlotBox field = rectangle_about(plots);
  if (beside == Beside::border) return {draw_border(plots, field, random)};
  return draw_objects(field, random);
}

void lift(std::span<Eigen::Vector3f> points, const std::vector<Thing>& things,
          RandomStream& random) {
  for (Eigen::Vector3f& point : points) {
    double highest_m = 0;
    for (const Thing& thing : things)
      highest_m = std::max(highest_m, return_height(thing, point.head<2>().cast<double>(), random));
    point.z() += static_cast<float>(highest_m);
  }
}

}  // namespace plotscan::strata
