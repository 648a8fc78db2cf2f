// SPDX-License-Identifier: Apache-2.0
#include "strata/empty_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"
#include "strata/random_draws.h"
#include "strata/scenery.h"

namespace plotscan::strata {
namespace {

using Things = std::vector<Thing>;

// About so many points a field, whatever its density.
constexpr double kFewestPoints = 1e5;
constexpr double kMostPoints = 9e5;

struct Scene {
  Things things = {};
  double relief_m = 0.3;
  std::optional<PlotBox> walls = std::nullopt;  // nothing beyond is seen
};

Eigen::Vector2d turned(const Eigen::Vector2d& local, double heading) {
  return {std::cos(heading) * local.x() - std::sin(heading) * local.y(),
          std::sin(heading) * local.x() + std::cos(heading) * local.y()};
}

double any_heading(RandomStream& random) { return random.uniform(0, kPi); }

// A tree or bush, a fifth wider or narrower than asked for.
Thing crown(const Eigen::Vector2d& place, double width_m, double height_m, RandomStream& random) {
  const double size = random.uniform(0.8, 1.2);
  return {.shape = Shape::crown,
          .outline = {.center = place,
                      .width_m = size * width_m * random.uniform(0.85, 1.15),
                      .length_m = size * width_m,
                      .heading_rad = any_heading(random)},
          .height_m = size * height_m,
          .cover = random.uniform(0.6, 0.95)};
}

// Trees on a grid, some missing.
Scene orchard(RandomStream& random) {
  const double heading = any_heading(random);
  const double width_m = random.uniform(1.5, 3.5);
  const double height_m = random.uniform(1.8, 4.5);
  const Eigen::Vector2d pitch_m{width_m + random.uniform(0.3, 2.5), width_m + random.uniform(1, 3)};
  const Eigen::Vector2i count{draw_count(random, 4, 8), draw_count(random, 4, 8)};
  Scene scene;
  for (int i = 0; i < count.x(); ++i) {
    for (int j = 0; j < count.y(); ++j) {
      if (chance(random, 0.05)) continue;
      const Eigen::Vector2d wander = 0.15 * Eigen::Vector2d{random.normal(), random.normal()};
      const Eigen::Vector2d local((i - (count.x() - 1) / 2.0) * pitch_m.x(),
                                  (j - (count.y() - 1) / 2.0) * pitch_m.y());
      scene.things.push_back(crown(turned(local + wander, heading), width_m, height_m, random));
    }
  }
  return scene;
}

// Trellised rows, some with a gap.
Scene vines(RandomStream& random) {
  const double heading = any_heading(random);
  const int rows = draw_count(random, 6, 12);
  const double pitch_m = random.uniform(1.8, 3);
  const double width_m = random.uniform(0.4, 0.9);
  const double length_m = random.uniform(12, 28);
  const double height_m = random.uniform(1.3, 2.2);
  const double cover = random.uniform(0.6, 0.95);
  Scene scene;
  for (int row = 0; row < rows; ++row) {
    double from_m = -length_m / 2;
    const double gap_m = chance(random, 0.3) ? random.uniform(-0.4, 0.4) * length_m : length_m / 2;
    for (const double to_m : {gap_m, length_m / 2}) {
      const Eigen::Vector2d local((from_m + to_m) / 2, (row - (rows - 1) / 2.0) * pitch_m);
      if (to_m - from_m > 0.5) {
        scene.things.push_back({.shape = Shape::hedge,
                                .outline = {.center = turned(local, heading),
                                            .width_m = width_m,
                                            .length_m = to_m - from_m,
                                            .heading_rad = heading},
                                .height_m = height_m,
                                .cover = cover});
      }
      from_m = to_m + 1;
    }
  }
  return scene;
}

// A car park: rows of bays, some empty.
Scene cars(RandomStream& random) {
  const double heading = any_heading(random);
  const int rows = draw_count(random, 2, 4);
  const int bays = draw_count(random, 7, 14);
  const double bay_m = random.uniform(2.4, 2.9);
  const double lane_m = random.uniform(5.2, 11);
  const double filled = random.uniform(0.6, 1);
  Scene scene{.relief_m = 0.05};
  for (int row = 0; row < rows; ++row) {
    for (int bay = 0; bay < bays; ++bay) {
      if (!chance(random, filled)) continue;
      const Eigen::Vector2d local{(bay - (bays - 1) / 2.0) * bay_m + 0.1 * random.normal(),
                                  (row - (rows - 1) / 2.0) * lane_m + 0.15 * random.normal()};
      const double turn = (chance(random, 0.5) ? 0.5 : -0.5) * kPi;
      scene.things.push_back({.shape = Shape::car,
                              .outline = {.center = turned(local, heading),
                                          .width_m = random.uniform(1.65, 1.95),
                                          .length_m = random.uniform(3.7, 5),
                                          .heading_rad = heading + turn + 0.02 * random.normal()},
                              .height_m = random.uniform(1.4, 1.9)});
    }
  }
  return scene;
}

Thing wall(const Eigen::Vector2d& local, double length_m, double heading, double height_m,
           double along) {
  constexpr double kThickness_m = 0.15;
  return {.shape = Shape::block,
          .outline = {.center = turned(local, heading),
                      .width_m = kThickness_m,
                      .length_m = length_m,
                      .heading_rad = heading + along},
          .height_m = height_m};
}

// Four walls, rows of tables and shelves on a level floor, and in half of the rooms a ceiling.
Scene room(RandomStream& random) {
  constexpr double kAcross = kPi / 2;
  const double heading = any_heading(random);
  const Eigen::Vector2d size_m{random.uniform(8, 20), random.uniform(6, 14)};
  const double height_m = random.uniform(2.4, 4);
  const PlotBox outline{
      .center = {0, 0}, .width_m = size_m.y(), .length_m = size_m.x(), .heading_rad = heading};
  Scene scene{.relief_m = 0, .walls = outline};
  if (chance(random, 0.5)) {
    scene.things.push_back(
        {.shape = Shape::block, .outline = outline, .height_m = height_m, .cover = 0.3});
  }
  for (const double side : {-0.5, 0.5}) {
    scene.things.push_back(wall({0, side * size_m.y()}, size_m.x(), heading, height_m, 0));
    scene.things.push_back(wall({side * size_m.x(), 0}, size_m.y(), heading, height_m, kAcross));
  }
  const double table_m = random.uniform(1.2, 2);
  const double deep_m = random.uniform(0.6, 0.9);
  const Eigen::Vector2d pitch_m{table_m + random.uniform(0.5, 1.2),
                                deep_m + random.uniform(0.8, 1.6)};
  // From one pitch off two walls to a metre off the others.
  const Eigen::Vector2i count = ((size_m.array() - 1) / pitch_m.array()).cast<int>();
  for (int i = 1; i <= count.x(); ++i) {
    for (int j = 1; j <= count.y(); ++j) {
      const Eigen::Vector2d local = -size_m / 2 + Eigen::Vector2d(i, j).cwiseProduct(pitch_m);
      if (chance(random, 0.25)) continue;
      scene.things.push_back({.shape = Shape::block,
                              .outline = {.center = turned(local, heading),
                                          .width_m = deep_m,
                                          .length_m = table_m,
                                          .heading_rad = heading + 0.03 * random.normal()},
                              .height_m = chance(random, 0.2) ? 1.8 : 0.74});
    }
  }
  return scene;
}

// A heap as high as a house.
Scene mound(RandomStream& random) {
  const double width_m = random.uniform(14, 24);
  return {.things = {{.shape = Shape::mound,
                      .outline = {.center = {random.uniform(-2, 2), random.uniform(-2, 2)},
                                  .width_m = width_m,
                                  .length_m = width_m * random.uniform(1, 1.4),
                                  .heading_rad = any_heading(random)},
                      .height_m = 10}}};
}

Scene building(RandomStream& random) {
  const double heading = any_heading(random);
  Scene scene;
  const int parts = draw_count(random, 1, 3);
  for (int part = 0; part < parts; ++part) {
    const Eigen::Vector2d local{random.uniform(-6, 6), random.uniform(-6, 6)};
    scene.things.push_back({.shape = chance(random, 0.5) ? Shape::roof : Shape::block,
                            .outline = {.center = turned(local, heading),
                                        .width_m = random.uniform(5, 10),
                                        .length_m = random.uniform(8, 18),
                                        .heading_rad = heading + (part % 2) * kPi / 2},
                            .height_m = random.uniform(3, 9)});
  }
  return scene;
}

Scene bushes(RandomStream& random) {
  const int count = draw_count(random, 15, 90);
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d place{random.uniform(-13, 13), random.uniform(-13, 13)};
    const double width_m = random.uniform(0.6, 2.4);
    const double height_m = random.uniform(0.4, 2);
    scene.things.push_back(crown(place, width_m, height_m, random));
  }
  return scene;
}

Scene bare(RandomStream& random) { return {.relief_m = random.uniform(0, 1)}; }

// One closed crop without a gap, and bare ground around it.
Scene sheet(RandomStream& random) {
  return {.things = {{.shape = Shape::canopy,
                      .outline = {.center = {0, 0},
                                  .width_m = random.uniform(10, 22),
                                  .length_m = random.uniform(14, 26),
                                  .heading_rad = any_heading(random)},
                      .height_m = random.uniform(0.4, 1.2)}},
          .relief_m = random.uniform(0, 0.5)};
}

struct Kind {
  std::string name;
  std::function<Scene(RandomStream&)> draw;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"orchard", orchard},   {"vines", vines},   {"cars", cars}, {"room", room},  {"mound", mound},
      {"building", building}, {"bushes", bushes}, {"bare", bare}, {"sheet", sheet}};
  return all;
}

// The square that holds all things, and ground around them.
double side_of(const Things& things, RandomStream& random) {
  double reach_m = 8;
  for (const Thing& thing : things) {
    for (const Eigen::Vector2d& corner : thing.outline.corners())
      reach_m = std::max(reach_m, corner.cwiseAbs().maxCoeff());
  }
  return 2 * (reach_m + random.uniform(2, 6));
}

}  // namespace

const std::vector<std::string>& empty_kinds() {
  static const std::vector<std::string> names = list_of<std::string>(kinds(), &Kind::name);
  return names;
}

std::vector<Eigen::Vector3f> draw_empty_field(const std::string& kind, RandomStream& random) {
  const auto found = std::ranges::find(kinds(), kind, &Kind::name);
  check(found != kinds().end(), "no kind of empty field " + kind);
  const Scene scene = found->draw(random);
  const Ground ground(scene.relief_m, random);
  ScanOptions options{.side_m = side_of(scene.things, random)};
  const double area_m2 = options.side_m * options.side_m;
  // Evenly over the factors between the ends, as densities of surveys are.
  options.density_m2 = std::clamp(100 * std::pow(10, random.uniform()), kFewestPoints / area_m2,
                                  kMostPoints / area_m2);
  options.noise_m = random.uniform(0.005, 0.04);
  std::vector<Eigen::Vector3f> points = scan(scene.things, ground, options, random);
  if (scene.walls) {
    std::erase_if(points, [&](const Eigen::Vector3f& point) {
      return !scene.walls->contains(point.head<2>().cast<double>());
    });
  }
  return points;
}

}  // namespace plotscan::strata
