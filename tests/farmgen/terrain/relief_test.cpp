// SPDX-License-Identifier: Apache-2.0
// Slope, rolling, furrows and clods against closed forms.
#include "terrain/internal/relief.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "terrain/internal/refine.h"
#include "terrain/make_terrain.h"

namespace plotscan::terrain {
namespace {

TerrainDescription square(double side_m, std::uint32_t vertices = 0, double relief_m = 0) {
  TerrainDescription description;
  description.side_m = side_m;
  description.vertices = vertices;
  description.relief_m = relief_m;
  return description;
}

Terrain made(const TerrainDescription& description, std::uint64_t seed = 1) {
  return make_terrain(description, {}, seed, "farm.yaml").terrain;
}

// Points of the square, away from its border.
std::vector<Eigen::Vector2d> random_points(double side_m, int count) {
  std::vector<Eigen::Vector2d> points;
  RandomStream random(11, random_purpose("test/points"), 0);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-0.49, 0.49) * side_m;
    points.emplace_back(x, random.uniform(-0.49, 0.49) * side_m);
  }
  return points;
}

// The power at a frequency (cycles a sample) of samples, by the sum itself: a sine of amplitude a
// has a^2 / 4 at its own, where the samples hold a whole number of its waves.
double power_at(const std::vector<double>& samples, double frequency) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    sum += samples[i] * std::polar(1.0, -2 * kPi * frequency * static_cast<double>(i));
  return std::norm(sum / static_cast<double>(samples.size()));
}

TEST(Relief, ASlopeIsAPlaneAtEveryPoint) {
  TerrainDescription description = square(60, 200);
  description.slope = {.gradient = 0.03, .direction_rad = radians(45)};
  const Terrain terrain = made(description);
  EXPECT_EQ(terrain.vertices().size(), 204u) << "a plane needs no more vertices";
  for (const Eigen::Vector2d& point : random_points(60, 500)) {
    EXPECT_NEAR(terrain.height(point.x(), point.y()).value(),
                0.03 * (point.x() + point.y()) / std::sqrt(2.0), 1e-12);
  }
}

TEST(Relief, PartsAddUpToTheBase) {
  TerrainDescription description = square(30, 60, 0.5);
  const Terrain base = made(description);
  description.slope = {.gradient = 0.05, .direction_rad = 2};
  description.rolling = {.rms_m = 0.2, .shortest_m = 8, .longest_m = 15};
  const std::vector<PlaneWave> rolling = rolling_waves(*description.rolling, 1);
  const Terrain terrain = made(description);
  for (const Eigen::Vector3d& vertex : terrain.vertices()) {
    const Eigen::Vector2d point = vertex.head<2>();
    const double slope_m = 0.05 * (std::cos(2.0) * point.x() + std::sin(2.0) * point.y());
    EXPECT_NEAR(vertex.z(),
                base.height(point.x(), point.y()).value() + slope_m + wave_height(rolling, point),
                1e-12);
  }
}

TEST(Relief, WavesOverALatticeAreWavesAtItsPoints) {
  const Lattice lattice =
      lattice_over({Eigen::Vector2d(-3, 1), Eigen::Vector2d(2, 5)},
                   {.heading_rad = 0.4, .column_step_m = 0.3, .row_step_m = 0.2, .offset_m = 0.1});
  const auto waves = clod_waves({.height_m = 0.03, .size_m = 0.5}, 3);
  const Eigen::MatrixXd heights_m = wave_heights(waves, lattice);
  for (Eigen::Index row = 0; row < lattice.rows; ++row) {
    for (Eigen::Index column = 0; column < lattice.columns; ++column) {
      ASSERT_NEAR(heights_m(row, column), wave_height(waves, lattice.point(row, column)), 1e-12);
    }
  }
}

TEST(Relief, FurrowsHaveTheirSpacingAmplitudeHeadingAndProfile) {
  for (const FurrowProfile profile : {FurrowProfile::sine, FurrowProfile::trapezoid}) {
    TerrainDescription description = square(24);
    description.furrows = {.spacing_m = 0.75,
                           .depth_m = 0.12,
                           .heading_rad = 0.5,
                           .offset_m = 0.2,
                           .profile = profile};
    const Terrain terrain = made(description);
    const Eigen::Vector2d along(std::cos(0.5), std::sin(0.5));
    const Eigen::Vector2d across(-std::sin(0.5), std::cos(0.5));
    std::vector<double> line;  // across 12 ridges
    for (int i = 0; i < 1200; ++i) {
      const double across_m = 0.2 - 4.5 + 9.0 * i / 1200;
      const Eigen::Vector2d point = across_m * across;
      line.push_back(terrain.height(point.x(), point.y()).value());
      // A ridge is level along its heading.
      const Eigen::Vector2d further = point + 3.217 * along;
      ASSERT_NEAR(terrain.height(further.x(), further.y()).value(), line.back(), 1e-9);
    }
    EXPECT_NEAR(*std::max_element(line.begin(), line.end()), 0.06, 1e-9);
    EXPECT_NEAR(*std::min_element(line.begin(), line.end()), -0.06, 1e-9);
    EXPECT_NEAR(line[600], 0.06, 1e-9) << "a ridge's top lies at the offset";
    // Amplitudes of the fundamental. Straight lines between n points of a sine: a sinc(1 / n)^2.
    // The Fourier series of the trapezoid: a (8 / pi^2) sin(pi / 4) * 2.
    const double between = std::pow(std::sin(kPi / 8) / (kPi / 8), 2);
    const double expected_m = profile == FurrowProfile::sine
                                  ? 0.06 * between
                                  : 0.06 * 16 / (kPi * kPi) * std::sin(kPi / 4);
    EXPECT_NEAR(2 * std::sqrt(power_at(line, 12.0 / 1200)), expected_m, 2e-5);
    for (const int ridges : {6, 11, 13, 18})
      EXPECT_LT(power_at(line, ridges / 1200.0), 1e-12) << ridges << " ridges in the line";
  }
}

TEST(Relief, FurrowsFadeOutAtTheBorderOfTheirRectangle) {
  TerrainDescription description = square(40);
  description.furrows = {.spacing_m = 0.5, .depth_m = 0.1};
  description.detail_m = {20, 10};
  const Terrain terrain = made(description);
  double highest_inside_m = 0;
  for (const Eigen::Vector3d& vertex : terrain.vertices()) {
    const bool inside = std::abs(vertex.x()) < 10 && std::abs(vertex.y()) < 5;
    if (!inside) {
      EXPECT_EQ(vertex.z(), 0) << vertex.transpose();
    }
    // Two metres inside the border they have their depth.
    if (std::abs(vertex.x()) < 8 && std::abs(vertex.y()) < 3)
      highest_inside_m = std::max(highest_inside_m, vertex.z());
    if (std::abs(vertex.y()) > 4.5) {
      EXPECT_LT(std::abs(vertex.z()), 0.05 * 0.16);
    }
  }
  EXPECT_NEAR(highest_inside_m, 0.05, 1e-12);
  EXPECT_EQ(terrain.height(15, 15), 0.0);
}

TEST(Relief, DetailCoversThePlotsWithAMarginWhereNoRectangleIsGiven) {
  TerrainDescription description = square(60);
  description.furrows = {.spacing_m = 0.8, .depth_m = 0.1};
  const std::vector<PlotBox> plots = {
      {.center = {10, -5}, .width_m = 2, .length_m = 6, .heading_rad = 0}};
  const Terrain terrain = make_terrain(description, plots, 1, "farm.yaml").terrain;
  for (const Eigen::Vector2d& corner : plots[0].corners()) {
    EXPECT_NEAR(terrain.height(corner.x(), corner.y()).value(),
                furrow_height(*description.furrows, corner.y()), 0.005);
  }
  for (const Eigen::Vector3d& vertex : terrain.vertices()) {
    const bool near = std::abs(vertex.x() - 10) < 6 && std::abs(vertex.y() + 5) < 4;
    if (!near) {
      EXPECT_EQ(vertex.z(), 0) << vertex.transpose();
    }
  }
}

TEST(Relief, RollingHasItsVarianceOverSeeds) {
  const RollingDescription rolling{.rms_m = 0.3, .shortest_m = 20, .longest_m = 60};
  constexpr int kSeeds = 400;
  double sum = 0;
  double square_sum = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto waves = rolling_waves(rolling, seed);
    for (const Eigen::Vector2d& point : {Eigen::Vector2d(0, 0), Eigen::Vector2d(500, 300)}) {
      const double height_m = wave_height(waves, point);
      sum += height_m / (2 * kSeeds);
      square_sum += height_m * height_m / (2 * kSeeds);
    }
  }
  // Of 800 independent normal heights: standard errors 0.3 / sqrt(800) and 0.09 sqrt(2 / 800).
  EXPECT_NEAR(sum, 0, 4 * 0.3 / std::sqrt(800.0));
  EXPECT_NEAR(square_sum, 0.09, 4 * 0.09 * std::sqrt(2.0 / 800));
}

TEST(Relief, RollingHasNoPowerOutsideItsBand) {
  const RollingDescription rolling{.rms_m = 0.3, .shortest_m = 20, .longest_m = 60};
  double inside = 0;
  double shorter = 0;
  constexpr int kSamples = 1000;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto waves = rolling_waves(rolling, seed);
    for (const PlaneWave& wave : waves) {
      const double length_m = 2 * kPi / wave.wave_number.norm();
      EXPECT_TRUE(length_m >= 20 - 1e-9 && length_m <= 60 + 1e-9) << length_m;
    }
    std::vector<double> line;  // 4 km, a Hann window against leaks from the band
    for (int i = 0; i < kSamples; ++i) {
      const double window = 1 - std::cos(2 * kPi * i / kSamples);
      line.push_back(window * wave_height(waves, {4.0 * i, 77}));
    }
    for (int waves_in_line = 1; waves_in_line < kSamples / 2; ++waves_in_line) {
      const double length_m = 4.0 * kSamples / waves_in_line;
      const double power = power_at(line, static_cast<double>(waves_in_line) / kSamples);
      // A wave that runs at an angle to the line is longer along it: only shorter ones are out.
      (length_m < 19.5 ? shorter : inside) += power;
    }
  }
  EXPECT_LT(shorter, 1e-6 * inside);
  EXPECT_GT(inside, 0.1);
}

TEST(Relief, ClodsHaveTheirHeightAndCorrelationLength) {
  const ClodsDescription clods{.height_m = 0.03, .size_m = 0.08};
  double variance = 0;
  double at_length = 0;
  constexpr int kSeeds = 200;
  constexpr int kPlaces = 20;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto waves = clod_waves(clods, seed);
    for (int i = 0; i < kPlaces; ++i) {
      const Eigen::Vector2d point(1.7 * i, -0.9 * i);
      const double here_m = wave_height(waves, point);
      variance += here_m * here_m / (kSeeds * kPlaces);
      at_length +=
          here_m * wave_height(waves, point + Eigen::Vector2d(0.08, 0)) / (kSeeds * kPlaces);
    }
  }
  EXPECT_NEAR(variance, 0.03 * 0.03, 0.06 * 0.03 * 0.03);
  // 1 / e, and the 1.8 % of short waves that are left out.
  EXPECT_NEAR(at_length / variance, std::exp(-1), 0.06);
  EXPECT_NEAR(shortest_clod_wave_m(clods), 0.08 * kPi / 2, 1e-12);
}

// Root mean square of the terrain's heights at many points against the asked one's: what straight
// lines between vertices leave of it.
TEST(Relief, VerticesAreCloseEnoughToShowTheRelief) {
  TerrainDescription rolling = square(200);
  rolling.rolling = {.rms_m = 0.3, .shortest_m = 10, .longest_m = 10};
  TerrainDescription clods = square(8);
  clods.clods = {.height_m = 0.03, .size_m = 0.1};
  for (const auto& [description, least_share, purpose] :
       {std::tuple{rolling, 0.9, "rolling"}, {clods, 0.9, "clods"}}) {
    const Terrain terrain = made(description);
    const auto waves = description.rolling ? rolling_waves(*description.rolling, 1)
                                           : clod_waves(*description.clods, 1);
    double terrain_power = 0;
    double wave_power = 0;
    for (const Eigen::Vector2d& point : random_points(description.side_m, 5000)) {
      terrain_power += std::pow(terrain.height(point.x(), point.y()).value(), 2);
      wave_power += std::pow(wave_height(waves, point), 2);
    }
    EXPECT_GT(terrain_power, least_share * wave_power) << purpose;
    EXPECT_LT(terrain_power, wave_power) << purpose;
  }
}

TEST(Relief, BreaklinesOfTheBaseStay) {
  TerrainDescription description = square(40, 80, 1.0);
  const Terrain base = made(description);
  description.furrows = {.spacing_m = 0.8, .depth_m = 0.12};
  description.detail_m = {44, 44};
  const Terrain rough = made(description);
  // Without the furrows again: what is left is how far the triangles cut across the base's edges.
  std::vector<Eigen::Vector3d> vertices = rough.vertices();
  const Relief relief(description, {Eigen::Vector2d(-22, -22), Eigen::Vector2d(22, 22)}, 2, 1);
  for (Eigen::Vector3d& vertex : vertices) vertex.z() -= relief.height(vertex.head<2>());
  const Terrain smooth(vertices, rough.triangles());
  double area_m2 = 0;
  for (const auto& triangle : rough.triangles()) {
    const Eigen::Vector2d a = vertices[triangle[0]].head<2>();
    const Eigen::Vector2d b = vertices[triangle[1]].head<2>() - a;
    const Eigen::Vector2d c = vertices[triangle[2]].head<2>() - a;
    area_m2 += (b.x() * c.y() - b.y() * c.x()) / 2;
  }
  EXPECT_NEAR(area_m2, 1600, 1e-6) << "the whole square is covered, once";
  double largest_m = 0;
  int off = 0;
  const auto points = random_points(40, 40000);
  for (const Eigen::Vector2d& point : points) {
    const double off_m = std::abs(smooth.height(point.x(), point.y()).value() -
                                  base.height(point.x(), point.y()).value());
    largest_m = std::max(largest_m, off_m);
    off += off_m > 1e-9;
  }
  RecordProperty("largest_deviation_mm", std::to_string(1000 * largest_m));
  RecordProperty("points_off", off);
  EXPECT_LT(largest_m, 0.02) << "where edges meet at sharp angles";
  EXPECT_LT(off, 400) << "of 40000";
}

}  // namespace
}  // namespace plotscan::terrain
