// SPDX-License-Identifier: Apache-2.0
#include "ground/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <tbb/task_arena.h>

#include "core/contains.h"
#include "core/error.h"
#include "ground/columns.h"
#include "ground/internal/bare_noise.h"
#include "ground/internal/lower_surface.h"
#include "ground/internal/misfit.h"
#include "ground/internal/mixture.h"
#include "ground/internal/plateaus.h"
#include "ground/internal/solver.h"
#include "ground/internal/uncertainty.h"

namespace plotscan::ground {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Mean size of the bends where ground is seen: the scale of the Laplace distribution assumed for
// bends.
double usual_bend(const Field& bends, const Field& data) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (data[i] <= 0) continue;
    sum += bends[i];
    ++count;
  }
  return std::max(2e-4, count > 0 ? sum / count : 0.01);
}

// One round of iterative reweighting (Daubechies et al., 2010): |bend| / scale is replaced by a
// square about the last bends, so that few nodes bend much and the others hardly.
Field stiffness_of(const Field& bends, double scale) {
  Field stiffness(bends.size());
  const double least = 0.1 * scale;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    stiffness[i] = static_cast<float>(1 / (scale * std::hypot(bends[i], least)));
  }
  return stiffness;
}

// Removes the ground where no ground return is within reach, by a chamfer distance over the grid.
void forget_beyond_reach(const Grid& grid, const Field& data, double reach_m, Surface& surface) {
  Field distance_m(grid.nodes());
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    distance_m[i] = data[i] > 0 ? 0 : std::numeric_limits<float>::infinity();
  }
  distance_m = slope_limited(grid, distance_m, 1);
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    if (distance_m[i] <= static_cast<float>(reach_m)) continue;
    surface.z_m[i] = kUnknown;
    surface.sd_m[i] = kUnknown;
    surface.misfit_m[i] = kUnknown;
    surface.seen[i] = 0;
  }
}

// Replaces the evidence at the nodes that `other` supports better.
void take_better(const Evidence& other, Evidence& evidence) {
  constexpr float kBetter = 0.2f;
  for (std::size_t i = 0; i < evidence.data.size(); ++i) {
    if (other.support[i] < evidence.support[i] + kBetter) continue;
    evidence.target_m[i] = other.target_m[i];
    evidence.data[i] = other.data[i];
    evidence.doubt_m[i] = other.doubt_m[i];
    evidence.support[i] = other.support[i];
  }
}

// How far above and below a surface returns still count, in sigmas (mixture.cpp looks no farther).
constexpr float kCountedBelow = 20;
constexpr float kCountedAbove = 11;

// One step towards the most likely surface: what the returns about it say, and the smoothest
// surface that agrees. Bends are taken to be of one size at first, then of a Laplace law.
void step(const Grid& grid, const Evidence& evidence, bool first, Field& z) {
  const Field bends = curvature(grid, z);
  constexpr float kFirstBend_m = 0.03f;
  const Fit fit{.target = evidence.target_m,
                .data = evidence.data,
                .stiffness = first ? Field(grid.nodes(), 1 / (kFirstBend_m * kFirstBend_m))
                                   : stiffness_of(bends, usual_bend(bends, evidence.data))};
  solve(grid, fit, {.most_iterations = 100, .tolerance_m = 5e-4}, z);
}

constexpr float kSupported = 0.3f;

std::vector<std::uint8_t> poorly_supported(const Evidence& evidence) {
  std::vector<std::uint8_t> poor(evidence.support.size());
  for (std::size_t i = 0; i < poor.size(); ++i) poor[i] = evidence.support[i] < kSupported;
  return poor;
}

constexpr int kFirstRounds = 3;
constexpr int kRounds = 6;

// The evidence of the ground and the surface fitted to it.
struct Ground {
  Field z_m;  // above the columns' base
  Evidence evidence;
  Layer layer;
};

// Where nothing supports the surface, it may cut off a ridge whose returns were taken for canopy.
// The doubt added there is half of the way up to the lowest layer, limited by how much this ground
// bends at all.
void doubt_the_unsupported(const Grid& grid, const Field& layers, double noise_m, Ground& ground) {
  constexpr double kBends = 2;
  constexpr double kLeast = 0.1;  // of the noise, on the levellest ground
  const Field bends = curvature(grid, ground.z_m);
  double squares = 0;
  for (const float bend : bends) squares += bend * bend;
  const auto most = static_cast<float>(
      std::max(kLeast * noise_m, kBends * std::sqrt(squares / static_cast<double>(bends.size()))));
  Evidence& evidence = ground.evidence;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (evidence.support[i] >= kSupported) continue;
    evidence.doubt_m[i] = std::min(0.5f * std::abs(layers[i] - ground.z_m[i]), most);
  }
}

// Reports the progress of the fit; its steps take about the same time.
class Steps {
 public:
  explicit Steps(const ProgressReport& progress) : progress_(progress) {}
  void done() {
    ++done_;
    if (progress_) progress_(std::min(1.0, done_ / kSteps));
  }

 private:
  static constexpr double kSteps = 3 + kFirstRounds + kRounds;  // two first surfaces, the draws
  const ProgressReport& progress_;
  int done_ = 0;
};

Ground find_ground(Columns low, double noise_m, Steps& steps) {
  const Grid grid = low.grid;
  Layer upright = upright_layer(low, noise_m);
  const std::vector<std::uint8_t> tops = plateaus(grid, upright.z_m, noise_m);
  if (contains(tops, 1)) {
    low = without(std::move(low), tops);
    upright = upright_layer(low, noise_m);
  }
  Ground ground{.z_m = lower_surface(low, upright, noise_m), .evidence = {}, .layer = {}};
  steps.done();
  LayerSurface layers = layer_surface(low, upright, noise_m);
  steps.done();
  const Evidence by_layers = weigh(low, layers.z_m, noise_m);
  for (int round = 0; round < kFirstRounds; ++round) {
    ground.evidence = weigh(low, ground.z_m, noise_m);
    take_better(by_layers, ground.evidence);
    step(grid, ground.evidence, true, ground.z_m);
    steps.done();
  }
  const auto noise = static_cast<float>(noise_m);
  const Columns near = near_part(std::move(low), ground.z_m, -kCountedBelow * noise,
                                 kCountedAbove * noise + 0.1f, poorly_supported(ground.evidence));
  for (int round = 0; round < kRounds; ++round) {
    ground.evidence = weigh(near, ground.z_m, noise_m);
    step(grid, ground.evidence, false, ground.z_m);
    steps.done();
  }
  doubt_the_unsupported(grid, layers.z_m, noise_m, ground);
  ground.layer = std::move(layers.layer);
  return ground;
}

// Cells that ground returns may lie apart where they are few.
constexpr double kReachCells = 4;
// Deviations of rough ground from a cell's bilinear patch, whatever the sensor's noise.
constexpr double kLeastSpread_m = 0.01;

// What the ground is found from.
struct LowReturns {
  Columns columns;
  double noise_m = 0;  // sigma of the heights about bare ground
  double noise_seen_m = 0;
  double spread_m = 0;  // the same about a bilinear patch of it
  Field excess_m = {};  // noise_excess_m of each node
};

LowReturns low_returns(std::span<const Eigen::Vector3f> points, const SurfaceOptions& options) {
  Columns columns = sort_into_columns(points, grid_of(points, options.cell_m));
  const std::vector<BlockSpread> blocks = block_spreads(columns);
  const double found_m = bare_noise_m(blocks);
  const double noise_m = options.noise_m ? std::max(*options.noise_m, kLeastNoise_m) : found_m;
  const double spread_m = std::max(noise_m, kLeastSpread_m);
  Field excess_m = noise_excess_m(columns.grid, blocks, std::max(found_m, spread_m));
  return {.columns = low_part(std::move(columns), static_cast<float>(0.4 + 6 * spread_m)),
          .noise_m = noise_m,
          .noise_seen_m = found_m,
          .spread_m = spread_m,
          .excess_m = std::move(excess_m)};
}

Surface fit(std::span<const Eigen::Vector3f> points, const SurfaceOptions& options) {
  auto [low, noise_m, noise_seen_m, spread_m, excess_m] = low_returns(points, options);
  Steps steps(options.progress);
  const Grid grid = low.grid;
  const BasePlane base = low.base;
  const Ground ground = find_ground(std::move(low), spread_m, steps);
  Surface surface{grid};
  surface.z_m = ground.z_m;
  surface.layers_m = std::move(excess_m);
  surface.seen.resize(grid.nodes());
  surface.noise_m = noise_m;
  surface.noise_seen_m = noise_seen_m;
  surface.errors = draw_errors(grid, ground.z_m, ground.evidence, spread_m);
  steps.done();
  surface.sd_m = spread_of(grid, surface.errors);
  surface.misfit_m = misfit(grid, ground.layer,
                            {.z_m = ground.z_m, .evidence = ground.evidence, .sd_m = surface.sd_m});
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    surface.sd_m[i] = std::hypot(surface.sd_m[i], surface.misfit_m[i]);
    const std::size_t row = i / grid.columns, column = i % grid.columns;
    const Eigen::Vector2d place(static_cast<double>(column), static_cast<double>(row));
    surface.z_m[i] += static_cast<float>(base.z_m + grid.cell_m * base.slope.dot(place));
    surface.seen[i] = ground.evidence.support[i] > 0.5f && ground.evidence.data[i] > 0;
  }
  forget_beyond_reach(grid, ground.evidence.data,
                      std::max(options.reach_m, kReachCells * grid.cell_m), surface);
  return surface;
}

// The lower left node of the cell that a place lies in, and where in the cell.
struct InCell {
  std::size_t node;
  double east, north;  // 0 to 1
};

std::optional<InCell> cell_of(const Surface& surface, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = (place - surface.origin) / surface.cell_m;
  const bool inside =
      at.x() >= 0 && at.y() >= 0 && at.x() <= surface.columns - 1 && at.y() <= surface.rows - 1;
  if (!inside || surface.columns < 2 || surface.rows < 2) return std::nullopt;
  const int column = std::min(static_cast<int>(at.x()), surface.columns - 2);
  const int row = std::min(static_cast<int>(at.y()), surface.rows - 2);
  return InCell{.node = surface.index(column, row), .east = at.x() - column, .north = at.y() - row};
}

double bilinear(const Surface& surface, const std::vector<float>& field,
                const Eigen::Vector2d& place) {
  const std::optional<InCell> cell = cell_of(surface, place);
  if (!cell) return kUnknown;
  const auto [i, east, north] = *cell;
  const std::size_t up = i + surface.columns;
  return (1 - north) * ((1 - east) * field[i] + east * field[i + 1]) +
         north * ((1 - east) * field[up] + east * field[up + 1]);
}

}  // namespace

double Surface::height(const Eigen::Vector2d& place) const { return bilinear(*this, z_m, place); }

double Surface::standard_error(const Eigen::Vector2d& place) const {
  return bilinear(*this, sd_m, place);
}

double Surface::misfit(const Eigen::Vector2d& place) const {
  return misfit_m.empty() ? 0 : bilinear(*this, misfit_m, place);
}

double Surface::layers(const Eigen::Vector2d& place) const {
  return layers_m.empty() ? 0 : bilinear(*this, layers_m, place);
}

bool Surface::seen_at(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d node = (place - origin) / cell_m;
  const auto column = static_cast<int>(std::lround(node.x()));
  const auto row = static_cast<int>(std::lround(node.y()));
  if (column < 0 || row < 0 || column >= columns || row >= rows) return false;
  return seen[index(column, row)] != 0;
}

double Surface::mean_standard_error(const PlotBox& box) const {
  if (!std::isfinite(standard_error(box.center))) return kUnknown;
  constexpr double kStep_m = 0.2;
  const int along = std::max(2, static_cast<int>(std::ceil(box.length_m / kStep_m)));
  const int across = std::max(2, static_cast<int>(std::ceil(box.width_m / kStep_m)));
  const std::size_t nodes = errors.grid.nodes();
  std::vector<double> means(errors.draws, 0);
  double doubt = 0;
  for (int a = 0; a < along; ++a) {
    for (int b = 0; b < across; ++b) {
      const Eigen::Vector2d place = box.center +
                                    ((a + 0.5) / along - 0.5) * box.length_m * box.length_axis() +
                                    ((b + 0.5) / across - 0.5) * box.width_m * box.width_axis();
      const Eigen::Vector2d at = (place - origin) / errors.grid.cell_m;
      const int column = std::clamp(static_cast<int>(at.x()), 0, errors.grid.columns - 1);
      const int row = std::clamp(static_cast<int>(at.y()), 0, errors.grid.rows - 1);
      const std::size_t node = errors.grid.index(column, row);
      doubt += errors.doubt_m[node] / (along * across);
      for (int draw = 0; draw < errors.draws; ++draw) {
        means[draw] += errors.heights_m[draw * nodes + node] / (along * across);
      }
    }
  }
  const double cells = std::max(1.0, box.length_m * box.width_m / (cell_m * cell_m));
  const double missed = misfit(box.center);
  double squares = doubt * doubt + missed * missed / cells;
  for (const double mean : means) squares += mean * mean / errors.draws;
  return std::sqrt(squares);
}

Eigen::Vector2d Surface::slope(const Eigen::Vector2d& place) const {
  const std::optional<InCell> cell = cell_of(*this, place);
  if (!cell) return Eigen::Vector2d::Constant(kUnknown);
  const auto [i, east, north] = *cell;
  const std::size_t up = i + columns;
  const double along_east = (1 - north) * (z_m[i + 1] - z_m[i]) + north * (z_m[up + 1] - z_m[up]);
  const double along_north = (1 - east) * (z_m[up] - z_m[i]) + east * (z_m[up + 1] - z_m[i + 1]);
  return Eigen::Vector2d(along_east, along_north) / cell_m;
}

Surface fit_surface(std::span<const Eigen::Vector3f> points, const SurfaceOptions& options) {
  if (options.cell_m && !(*options.cell_m >= 0.02 && *options.cell_m <= 10)) {
    throw InputError("the ground's cell is " + std::to_string(*options.cell_m) +
                     " m; it has to lie in 0.02 to 10 m");
  }
  if (options.noise_m && !(*options.noise_m >= 0 && *options.noise_m <= 1)) {
    throw InputError("the noise of heights is " + std::to_string(*options.noise_m) +
                     " m; it has to lie in 0 to 1 m");
  }
  tbb::task_arena arena(std::max(1, options.threads));
  return arena.execute([&] { return fit(points, options); });
}

}  // namespace plotscan::ground
