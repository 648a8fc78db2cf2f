// SPDX-License-Identifier: Apache-2.0
#include "terrain/make_terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "mesh/mesh_import.h"
#include "terrain/extent.h"
#include "terrain/internal/base_terrains.h"
#include "terrain/internal/lattice.h"
#include "terrain/internal/refine.h"

namespace plotscan::terrain {
namespace {

// Furrows and clods reach this far beyond the plots, and fade out in the outer part of it.
constexpr double kMargin_m = 3;
constexpr double kFade_m = 2;
// Distances of vertices where none is given, and how much more is allowed: pieces of straight line
// between n points a wavelength keep all but (1 - cos(2 pi / n)) / 3 of a wave's variance. That is
// 6 % of the shortest rolling waves', 10 % of the furrows' and 23 % of the finest clods', 3 % of
// the mean clods'.
constexpr double kRollingPoints = 10;
constexpr double kFurrowPoints = 8;
constexpr double kClodPoints = 5;
constexpr double kCoarsest = 2;
constexpr double kFarthestOnMap_m = 1e9;  // of a map's coordinates, in any system

using Triangle = std::array<std::uint32_t, 3>;

Terrain mesh_terrain(const TerrainDescription& description) {
  const mesh::Mesh mesh = mesh::import_mesh(*description.mesh, description.mesh_options);
  try {
    return {list_of<Eigen::Vector3d>(mesh.vertices,
                                     [](const Eigen::Vector3f& v) { return v.cast<double>(); }),
            mesh.triangles};
  } catch (const InputError& error) {
    throw InputError(*description.mesh, error.what());
  }
}

MadeTerrain xyz_terrain(const XyzDescription& description) {
  std::vector<Eigen::Vector3d> vertices = read_xyz(description.file);
  for (const Eigen::Vector3d& vertex : vertices) {
    if (vertex.cwiseAbs().maxCoeff() > kFarthestOnMap_m)
      throw InputError(description.file, "has a coordinate beyond {:g}; no map has",
                       kFarthestOnMap_m);
  }
  std::optional<Eigen::Vector3d> origin_m;
  if (!description.keep_coordinates) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& vertex : vertices) bounds.extend(vertex);
    origin_m = bounds.center();
  }
  std::vector<Eigen::Vector2d> places;
  for (Eigen::Vector3d& vertex : vertices) {
    if (origin_m) vertex -= *origin_m;
    places.emplace_back(vertex.head<2>());
  }
  try {
    return {.terrain = {std::move(vertices), delaunay_triangles(places)}, .origin_m = origin_m};
  } catch (const InputError& error) {
    throw InputError(description.file, error.what());
  }
}

MadeTerrain make_base(const TerrainDescription& description, std::uint64_t seed) {
  if (description.mesh) return {.terrain = mesh_terrain(description), .origin_m = {}};
  if (description.heightmap)
    return {.terrain = heightmap_terrain(*description.heightmap), .origin_m = {}};
  if (description.xyz) return xyz_terrain(*description.xyz);
  return {.terrain =
              random_terrain(description.side_m, description.vertices, description.relief_m, seed),
          .origin_m = {}};
}

// The rectangle of furrows and clods: the one given, else the plots' with a margin, else more than
// the terrain.
Eigen::AlignedBox2d detail_box(const TerrainDescription& description,
                               const std::vector<PlotBox>& plots,
                               const Eigen::AlignedBox2d& bounds) {
  if (description.detail_m) {
    const Eigen::Vector2d half(description.detail_m->at(0) / 2, description.detail_m->at(1) / 2);
    return {-half, half};
  }
  Eigen::AlignedBox2d box = extent_of(plots);
  if (box.isEmpty()) box = bounds;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin_m);
  return {box.min() - margin, box.max() + margin};
}

// The distance of vertices that shows furrows and clods.
double detail_step_m(const TerrainDescription& description) {
  double step_m = std::numeric_limits<double>::infinity();
  if (description.furrows) step_m = description.furrows->spacing_m / kFurrowPoints;
  if (description.clods)
    step_m = std::min(step_m, shortest_clod_wave_m(*description.clods) / kClodPoints);
  return step_m;
}

// Rows along the furrows, a whole number of them from ridge to ridge: on the tops and bottoms and
// on the edges of a trapezoid's.
LatticeLayout detail_layout(const TerrainDescription& description, double step_m) {
  if (!description.furrows) return {.column_step_m = step_m, .row_step_m = step_m};
  const FurrowsDescription& furrows = *description.furrows;
  const double unit = furrows.profile == FurrowProfile::trapezoid ? 8 : 2;
  const double rows = unit * std::ceil(furrows.spacing_m / step_m / unit * (1 - 1e-9));
  return {.heading_rad = furrows.heading_rad,
          .column_step_m = step_m,
          .row_step_m = furrows.spacing_m / rows,
          .offset_m = furrows.offset_m};
}

double chosen_step_m(const TerrainDescription& description, double needed_m) {
  if (!description.step_m) return needed_m;
  if (*description.step_m <= kCoarsest * needed_m) return *description.step_m;
  throw InputError(
      fmt::format("terrain.step_m {:g} is too coarse for the terrain's finest relief: at "
                  "most {:.3g} m would show it, {:.3g} m shows it well",
                  *description.step_m, kCoarsest * needed_m, needed_m));
}

// A lattice covers the patch with rows along the furrows, so that of one askew to a long strip only
// few places are needed.
void require_small_lattice(const Patch& patch) {
  constexpr double kMostPlaces = 4.0 * static_cast<double>(kMostTerrainVertices);
  const Lattice lattice = lattice_over(patch.box, patch.layout);
  const double places = static_cast<double>(lattice.rows) * static_cast<double>(lattice.columns);
  if (places <= kMostPlaces) return;
  const Eigen::Vector2d size = patch.box.sizes();
  throw InputError(fmt::format(
      "terrain: rows along the furrows that cover {:.1f} m x {:.1f} m askew have {:.3g} places "
      "{:.3g} m "
      "apart; at most {:.3g} are allowed: furrows along that rectangle, a shorter terrain.detail_m "
      "or a greater terrain.step_m would fit",
      size.x(), size.y(), places, patch.layout.column_step_m, kMostPlaces));
}

void require_countable(const Terrain& base, const std::vector<Patch>& patches) {
  const double count = refined_vertices(base, patches);
  const auto most = static_cast<double>(kMostTerrainVertices);
  if (count <= most) {
    for (const Patch& patch : patches) require_small_lattice(patch);
    return;
  }
  const Patch& finest = patches.back();
  const Eigen::Vector2d size = finest.box.sizes();
  throw InputError(fmt::format(
      "terrain: vertices {:.3g} m apart over {:.1f} m x {:.1f} m are about {:.3g}; at most {:.3g} "
      "are "
      "allowed: terrain.step_m from {:.2g} on would fit where the relief allows it, or a smaller "
      "terrain.detail_m, or longer waves",
      finest.layout.column_step_m, size.x(), size.y(), count, most,
      1.05 * finest.layout.column_step_m * std::sqrt(count / most)));
}

std::vector<Patch> patches_of(const TerrainDescription& description,
                              const Eigen::AlignedBox2d& bounds,
                              const Eigen::AlignedBox2d& detail) {
  std::vector<Patch> patches;
  const bool fine = description.furrows || description.clods;
  if (description.rolling) {
    const double needed_m = description.rolling->shortest_m / kRollingPoints;
    const double step_m = fine ? needed_m : chosen_step_m(description, needed_m);
    patches.push_back({bounds, {.column_step_m = step_m, .row_step_m = step_m}});
  }
  const Eigen::AlignedBox2d inside = detail.intersection(bounds);
  if (fine && !inside.isEmpty()) {
    double needed_m = detail_step_m(description);
    if (description.rolling)
      needed_m = std::min(needed_m, description.rolling->shortest_m / kRollingPoints);
    patches.push_back({inside, detail_layout(description, chosen_step_m(description, needed_m))});
  }
  return patches;
}

}  // namespace

MadeTerrain make_terrain(const TerrainDescription& description, const std::vector<PlotBox>& plots,
                         std::uint64_t seed, const std::filesystem::path& source) {
  MadeTerrain made = make_base(description, seed);
  const bool has_relief =
      description.slope || description.rolling || description.furrows || description.clods;
  if (!has_relief) return made;
  try {
    const Eigen::AlignedBox2d bounds = outline_of(made.terrain);
    const Eigen::AlignedBox2d detail = detail_box(description, plots, bounds);
    const std::vector<Patch> patches = patches_of(description, bounds, detail);
    require_countable(made.terrain, patches);
    const double fade_m = std::min(kFade_m, detail.sizes().minCoeff() / 4);
    made.terrain = refined(made.terrain, Relief(description, detail, fade_m, seed), patches);
  } catch (const InputError& error) {
    throw InputError(source, error.what());
  }
  return made;
}

}  // namespace plotscan::terrain
