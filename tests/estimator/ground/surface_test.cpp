// SPDX-License-Identifier: Apache-2.0
#include "ground/surface.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "synthetic_field.h"

namespace plotscan::ground {
namespace {

const Terrain kPlane = [](double x, double y) { return 5 + 0.15 * x - 0.08 * y; };
const Terrain kWaves = [](double x, double y) {
  return 0.15 * std::sin(0.8 * x) * std::cos(0.6 * y) + 0.05 * x;
};

TEST(FitSurface, FindsAPlaneAndItsNoise) {
  const Surface surface = fit_surface(returns_of({.terrain = kPlane}), SurfaceOptions());
  EXPECT_NEAR(surface.noise_m, 0.03, 0.003);
  for (double x = -5; x <= 5; x += 0.5) {
    for (double y = -5; y <= 5; y += 0.5) {
      EXPECT_NEAR(surface.height({x, y}), kPlane(x, y), 0.01);
      EXPECT_NEAR(surface.slope({x, y}).x(), 0.15, 0.05);
      EXPECT_NEAR(surface.slope({x, y}).y(), -0.08, 0.05);
      EXPECT_LT(surface.standard_error({x, y}), 0.01);
    }
  }
}

// Of columns that hold 4 returns each, the few that hold 20 more tell of the canopy in them.
TEST(FitSurface, TakesNoNoiseFromAFewFullColumns) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 40000; ++i) {
    RandomStream random(3, random_purpose("test/sparse"), i);
    const auto x = static_cast<float>(i % 200) / 10, y = static_cast<float>(i / 200) / 10;
    points.emplace_back(x, y, static_cast<float>(0.02 * random.normal()));
    if (i >= 180) continue;
    points.emplace_back(static_cast<float>(random.uniform(10, 11.2)),
                        static_cast<float>(random.uniform(9.9, 10.1)),
                        static_cast<float>(random.uniform(0.3, 0.9)));
  }
  EXPECT_LT(fit_surface(points, SurfaceOptions()).noise_m, 0.05);
}

// 6 returns a column, of which 16 are wanted, over strips of canopy 1.2 m wide with alleys of 1 m:
// the few columns that hold 16 by chance lie in the canopy, where strips of the flight overlap.
TEST(FitSurface, FindsTheNoiseOfASparseCloud) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 72000; ++i) {
    RandomStream random(4, random_purpose("test/alleys"), i);
    const double x = random.uniform(0, 20), y = random.uniform(0, 20);
    const bool canopy = std::fmod(y, 2.2) < 1.2;
    const double low = 0.02 * random.normal();
    if (!canopy && i >= 60000) continue;  // twice as dense over the canopy
    points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(canopy ? random.uniform(0.4, 0.9) : low));
  }
  EXPECT_NEAR(fit_surface(points, SurfaceOptions()).noise_m, 0.02, 0.007);
}

// Cut to its plots, whose gaps of 0.2 m are a fourteenth of it, with a return from the ground in
// twenty between the leaves.
TEST(FitSurface, FindsTheNoiseOfACloudThatIsCutToThePlots) {
  std::vector<PlotBox> plots;
  for (int i = -2; i <= 2; ++i)
    plots.push_back(
        {.center = {2.4 * i, 0}, .width_m = 2.2, .length_m = 12, .heading_rad = M_PI_2});
  const SyntheticField field = {
      .terrain = kWaves, .returns_m2 = 1500, .noise_m = 0.02, .plots = plots, .gaps = 0.05};
  const Surface surface = fit_surface(returns_of(field), SurfaceOptions());
  EXPECT_NEAR(surface.noise_m, 0.02, 0.003);
  for (const PlotBox& plot : plots) EXPECT_NEAR(mean_error(surface, kWaves, plot), 0, 0.02);
}

// One point is left in each voxel of 0.1 m: the canopy's columns hold several times those of bare
// ground.
TEST(FitSurface, FindsTheNoiseBelowACanopyThatIsDenserThanTheGround) {
  std::vector<Eigen::Vector3f> points;
  std::set<std::array<int, 3>> voxels;
  const SyntheticField field{.terrain = kPlane,
                             .returns_m2 = 2000,
                             .plots = two_rows_of_plots(),
                             .canopy_low_m = 0.1,
                             .canopy_high_m = 1.2};
  for (const Eigen::Vector3f& point : returns_of(field)) {
    const Eigen::Array3i voxel = (10 * point.array()).floor().cast<int>();
    if (voxels.insert({voxel.x(), voxel.y(), voxel.z()}).second) points.push_back(point);
  }
  const Surface surface = fit_surface(points, SurfaceOptions());
  EXPECT_LT(surface.noise_m, 0.06);
  for (const PlotBox& plot : field.plots) EXPECT_NEAR(mean_error(surface, kPlane, plot), 0, 0.05);
}

TEST(FitSurface, TakesBareGroundWithoutNoise) {
  const Surface surface =
      fit_surface(returns_of({.terrain = kWaves, .noise_m = 0}), SurfaceOptions());
  EXPECT_LT(surface.noise_m, 0.006);
  for (double x = -5; x <= 5; x += 0.5) {
    EXPECT_NEAR(surface.height({x, 0.3 * x}), kWaves(x, 0.3 * x), 0.004);
  }
}

TEST(FitSurface, KeepsABreakline) {
  const Terrain roof = [](double x, double) { return -0.4 * std::abs(x - 0.33); };
  const Surface surface = fit_surface(returns_of({.terrain = roof}), SurfaceOptions());
  for (double y = -5; y <= 5; y += 0.25) {
    EXPECT_NEAR(surface.height({0.33, y}), 0, 0.04);  // half a cell may be cut off: 2 cm
    for (const double x : {-3.0, -0.3, 1.0, 4.0}) {
      EXPECT_NEAR(surface.height({x, y}), roof(x, y), 0.012) << x << ' ' << y;
    }
  }
}

TEST(FitSurface, SeesTheGroundThroughACanopy) {
  const SyntheticField field = {.terrain = kWaves,
                                .returns_m2 = 1500,
                                .plots = two_rows_of_plots(),
                                .canopy_low_m = 0.05,
                                .gaps = 0.15};
  const Surface surface = fit_surface(returns_of(field), SurfaceOptions());
  for (const PlotBox& plot : field.plots) {
    EXPECT_NEAR(mean_error(surface, kWaves, plot), 0, 0.005);
    EXPECT_LT(surface.mean_standard_error(plot), 0.01);
  }
}

TEST(FitSurface, BridgesAClosedCanopyAndSaysSo) {
  const SyntheticField field = {.terrain = kPlane, .plots = two_rows_of_plots(), .gaps = 0};
  const Surface surface = fit_surface(returns_of(field), SurfaceOptions());
  for (const PlotBox& plot : field.plots) {
    EXPECT_NEAR(mean_error(surface, kPlane, plot), 0, 0.015);
    EXPECT_GT(surface.standard_error(plot.center), 1.5 * surface.standard_error({1.05, 0}));
    const Eigen::Vector2d at = (plot.center - surface.origin) / surface.cell_m;
    const int node =
        static_cast<int>(at.y() + 0.5) * surface.columns + static_cast<int>(at.x() + 0.5);
    EXPECT_EQ(surface.seen[node], 0);
  }
}

TEST(FitSurface, HoldsAgainstStrayPoints) {
  const SyntheticField field = {.terrain = kWaves, .plots = two_rows_of_plots()};
  std::vector<Eigen::Vector3f> points = returns_of(field);
  RandomStream random(6, random_purpose("test/ground"), 0);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-6, 6), y = random.uniform(-6, 6);
    const double off = i % 2 == 0 ? random.uniform(-8, -0.5) : random.uniform(2, 30);
    points.emplace_back(x, y, kWaves(x, y) + off);
  }
  points.emplace_back(900.f, -700.f, 3.f);
  points.emplace_back(0.f, 0.f, std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < 500; ++i) points.push_back(points[i]);
  const Surface surface = fit_surface(points, SurfaceOptions());
  EXPECT_LT(surface.columns, 80);
  for (const PlotBox& plot : field.plots) {
    EXPECT_NEAR(mean_error(surface, kWaves, plot), 0, 0.01);
  }
}

// A flight that lies 8 cm higher over the east of the field, where both flights' returns mix.
TEST(FitSurface, KnowsWhereTwoLayersOfGroundLie) {
  std::vector<Eigen::Vector3f> points =
      returns_of({.terrain = kPlane, .side_m = 30, .plots = two_rows_of_plots()});
  const Surface one = fit_surface(points, SurfaceOptions());
  for (std::size_t i = 0; i < points.size(); i += 2)
    if (points[i].x() > 4) points[i].z() += 0.08f;
  const Surface two = fit_surface(points, SurfaceOptions());
  for (double y = -10; y <= 10; y += 0.5) {
    for (double x = -10; x <= 10; x += 0.5) EXPECT_EQ(one.layers({x, y}), 0);
    EXPECT_EQ(two.layers({-5, y}), 0);
    EXPECT_NEAR(two.layers({10, y}), 0.04, 0.01);  // half of what lies between
  }
}

TEST(FitSurface, HasNoGroundBeyondReach) {
  std::vector<Eigen::Vector3f> points = returns_of({.terrain = kWaves, .side_m = 20});
  std::erase_if(points, [](const Eigen::Vector3f& p) { return p.x() > 0 && p.y() > 0; });
  const Surface surface = fit_surface(points, SurfaceOptions());
  EXPECT_TRUE(std::isfinite(surface.height({1, 1})));
  EXPECT_GT(surface.standard_error({2, 2}), 3 * surface.standard_error({-2, -2}));
  EXPECT_TRUE(std::isnan(surface.height({8, 8})));
  EXPECT_TRUE(std::isnan(surface.standard_error({8, 8})));
  const PlotBox beyond = {.center = {8, 8}, .width_m = 1, .length_m = 1, .heading_rad = 0};
  EXPECT_TRUE(std::isnan(surface.mean_standard_error(beyond)));
  EXPECT_TRUE(std::isnan(surface.height({100, 0})));
}

// The corners of the box around a round survey hold no return.
TEST(FitSurface, GoesOnAlongTheGroundBeyondTheSurvey) {
  auto points = returns_of({.terrain = kPlane, .side_m = 20});
  std::erase_if(points, [](const Eigen::Vector3f& point) { return point.head<2>().norm() > 10; });
  const Surface surface = fit_surface(points, SurfaceOptions());
  for (double x = 7.3; x <= 8.5; x += 0.2) {
    for (const double y : {-x, x}) EXPECT_NEAR(surface.height({x, y}), kPlane(x, y), 0.1);
  }
}

TEST(FitSurface, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::vector<Eigen::Vector3f> points =
      returns_of({.terrain = kWaves, .plots = two_rows_of_plots()});
  SurfaceOptions options;
  const Surface one = fit_surface(points, options);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const Surface many = fit_surface(points, options);
    ASSERT_EQ(one.z_m.size(), many.z_m.size());
    EXPECT_EQ(std::memcmp(one.z_m.data(), many.z_m.data(), 4 * one.z_m.size()), 0);
    EXPECT_EQ(std::memcmp(one.sd_m.data(), many.sd_m.data(), 4 * one.sd_m.size()), 0);
    EXPECT_EQ(one.seen, many.seen);
    EXPECT_EQ(one.errors.heights_m, many.errors.heights_m);
  }
}

// Plots on many random grounds, through whose canopies much, little or no ground is seen: the truth
// lies within 1.96 standard errors about as often as it should.
TEST(FitSurface, GivesHonestStandardErrors) {
  int inside = 0, all = 0;
  double worst = 0;
  for (int seed = 0; seed < 24; ++seed) {
    RandomStream random(seed, random_purpose("test/ground/terrain"), 0);
    const double a = random.uniform(0.02, 0.2), k = random.uniform(0.4, 1.2);
    const double at = random.uniform(0, 6);
    const Terrain terrain = [=](double x, double y) {
      return a * std::sin(k * x + at) * std::cos(0.7 * k * y - at) + a * std::abs(y - 0.4 * x - at);
    };
    const SyntheticField field = {.terrain = terrain,
                                  .plots = two_rows_of_plots(),
                                  .gaps = std::array{0.2, 0.05, 0.0}[seed % 3],
                                  .seed = static_cast<std::uint64_t>(seed)};
    const Surface surface = fit_surface(returns_of(field), SurfaceOptions());
    for (const PlotBox& plot : field.plots) {
      const double off = mean_error(surface, terrain, plot) / surface.mean_standard_error(plot);
      inside += std::abs(off) < 1.96;
      worst = std::max(worst, std::abs(off));
      ++all;
    }
  }
  EXPECT_GT(inside, 0.88 * all);
  EXPECT_LT(worst, 6);
}

// Airborne: one return on 2 square metres of long waves. Cells of 0.2 m were off by centimetres.
TEST(FitSurface, HasWideCellsWherePointsAreFew) {
  const Terrain hills = [](double x, double y) {
    return 2 * std::sin(0.05 * x) + std::cos(0.04 * y);
  };
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    RandomStream random(11, random_purpose("test/airborne"), i);
    const double x = random.uniform(0, 100), y = random.uniform(0, 100);
    points.emplace_back(x, y, hills(x, y) + 0.02 * random.normal());
  }
  const Surface surface = fit_surface(points, SurfaceOptions());
  EXPECT_NEAR(surface.cell_m, 2, 0.3);
  double squares = 0, bias = 0, count = 0;
  for (double x = 4; x <= 96; x += 1.7) {
    for (double y = 4; y <= 96; y += 1.7) {
      const double off = surface.height({x, y}) - hills(x, y);
      squares += off * off;
      bias += off;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.04);
  EXPECT_NEAR(bias / count, 0, 0.01);
}

// Waves of all lengths from 2 to 40 m in all directions, the longer the higher, on a slope.
Terrain rough_terrain(std::uint64_t seed, double steepness, double slope) {
  struct Wave {
    double x, y, height, at;
  };
  std::vector<Wave> waves;
  RandomStream random(seed, random_purpose("test/ground/rough"), 0);
  for (int i = 0; i < 40; ++i) {
    const double per_m = M_PI * std::pow(20, -random.uniform());
    const double towards = random.uniform(0, 2 * M_PI);
    waves.push_back({per_m * std::cos(towards), per_m * std::sin(towards), steepness / per_m,
                     random.uniform(0, 2 * M_PI)});
  }
  return [=](double x, double y) {
    double z = slope * x;
    for (const Wave& wave : waves) z += wave.height * std::sin(wave.x * x + wave.y * y + wave.at);
    return z;
  };
}

// Of the places 4 m from the edge of a square field and farther.
struct Coverage {
  double places = 0;
  double known = 0;   // with a ground
  double inside = 0;  // whose true ground lies within 1.96 standard errors

  void add(const Surface& surface, const Terrain& terrain, double side_m) {
    for (double x = 4 - 0.5 * side_m; x <= 0.5 * side_m - 4; x += 0.37) {
      for (double y = 4 - 0.5 * side_m; y <= 0.5 * side_m - 4; y += 0.43) {
        const double off = surface.height({x, y}) - terrain(x, y);
        ++places;
        known += std::isfinite(off);
        inside += std::abs(off) < 1.96 * surface.standard_error({x, y});
      }
    }
  }
};

// Airborne, a return a square metre or three: the ground between them is most of the error. Slopes
// of the waves are 0.09 and 0.18 rms, on a plain and on a hillside.
TEST(FitSurface, GivesHonestStandardErrorsWherePointsAreFew) {
  struct Case {
    int returns_m2;
    double most_inside;  // intervals that hold everything say nothing
  };
  for (const auto& [returns_m2, most_inside] : {Case{1, 0.95}, Case{3, 0.985}}) {
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Terrain terrain = rough_terrain(seed, seed % 2 == 0 ? 0.02 : 0.04, seed < 4 ? 0 : 0.3);
      const SyntheticField field = {.terrain = terrain,
                                    .side_m = 60,
                                    .returns_m2 = returns_m2,
                                    .noise_m = 0.02,
                                    .seed = 40 + seed};
      coverage.add(fit_surface(returns_of(field), SurfaceOptions()), terrain, field.side_m);
    }
    EXPECT_GT(coverage.known, 0.85 * coverage.places) << returns_m2 << " returns a m2";
    EXPECT_GT(coverage.inside, 0.90 * coverage.known) << returns_m2 << " returns a m2";
    EXPECT_LT(coverage.inside, most_inside * coverage.known) << returns_m2 << " returns a m2";
  }
}

TEST(FitSurface, TakesTheNoiseThatIsGiven) {
  SurfaceOptions options;
  options.noise_m = 0.05;
  EXPECT_EQ(fit_surface(returns_of({.terrain = kPlane}), options).noise_m, 0.05);
}

TEST(FitSurface, RefusesOptionsOutOfRangeAndACloudWithoutPoints) {
  EXPECT_THROW(fit_surface({}, SurfaceOptions()), InputError);
  const std::vector<Eigen::Vector3f> points(100, Eigen::Vector3f::Zero());
  SurfaceOptions options;
  options.cell_m = 0;
  EXPECT_THROW(fit_surface(points, options), InputError);
  options.cell_m = 0.2;
  options.noise_m = -0.01;
  EXPECT_THROW(fit_surface(points, options), InputError);
}

}  // namespace
}  // namespace plotscan::ground
