// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/k_means.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points blobs(int count, int points_each, double spread_m, std::uint64_t seed) {
  RandomStream random(seed, random_purpose("test/blobs"), 0);
  Points points;
  for (int blob = 0; blob < count; ++blob) {
    for (int i = 0; i < points_each; ++i) {
      points.emplace_back(static_cast<float>(4 * blob + spread_m * random.normal()),
                          static_cast<float>(spread_m * random.normal()),
                          static_cast<float>(spread_m * random.normal()));
    }
  }
  return points;
}

double inertia(const Points& points, const std::vector<std::uint32_t>& cluster_of, int clusters) {
  double total = 0;
  for (int cluster = 0; cluster < clusters; ++cluster) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (static_cast<int>(cluster_of[i]) != cluster) continue;
      sum += points[i].cast<double>();
      ++count;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (static_cast<int>(cluster_of[i]) == cluster)
        total += (points[i].cast<double>() - sum / count).squaredNorm();
    }
  }
  return total;
}

// The least inertia over every assignment of the points to clusters.
double brute_force(const Points& points, int clusters) {
  std::vector<std::uint32_t> assignment(points.size(), 0);
  double best = std::numeric_limits<double>::infinity();
  while (true) {
    best = std::min(best, inertia(points, assignment, clusters));
    std::size_t digit = 0;
    while (digit < assignment.size() &&
           ++assignment[digit] == static_cast<std::uint32_t>(clusters)) {
      assignment[digit++] = 0;
    }
    if (digit == assignment.size()) return best;
  }
}

TEST(KMeans, FindsTheOptimumOfTinySets) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, random_purpose("test/tiny"), 0);
    Points points;
    for (int i = 0; i < 9; ++i) {
      points.emplace_back(static_cast<float>(random.uniform()),
                          static_cast<float>(random.uniform()),
                          static_cast<float>(random.uniform()));
    }
    const Clustering found = k_means(points, {.clusters = 3, .restarts = 10});
    const double optimum = brute_force(points, 3);
    EXPECT_NEAR(found.inertia_m2, optimum, 1e-5) << "seed " << seed;
    EXPECT_NEAR(inertia(points, found.cluster_of, 3), optimum, 1e-5) << "seed " << seed;
  }
}

TEST(KMeans, SeparatesBlobsWhenTheRestartsSeeOnlyASample) {
  const Points points = blobs(8, 5000, 0.3, 2);
  const Clustering found = k_means(points, {.clusters = 8, .sample_points = 1000});
  for (int blob = 0; blob < 8; ++blob) {
    const auto first = found.cluster_of.begin() + 5000 * blob;
    EXPECT_TRUE(std::all_of(first, first + 5000, [&](auto cluster) { return cluster == *first; }))
        << "blob " << blob;
  }
}

TEST(KMeans, GivesEveryPointToItsNearestCenter) {
  const Points points = blobs(5, 4000, 2, 5);  // overlapping
  const Clustering found = k_means(points, {.clusters = 9, .restarts = 1});
  double inertia_m2 = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto nearest = std::ranges::min_element(
        found.centers, {}, [&](const auto& center) { return (center - points[i]).squaredNorm(); });
    EXPECT_EQ(found.cluster_of[i], nearest - found.centers.begin());
    inertia_m2 += (*nearest - points[i]).squaredNorm();
  }
  EXPECT_NEAR(found.inertia_m2, inertia_m2, 1e-6 * inertia_m2);
}

TEST(KMeans, GivesTheSameForAnyNumberOfThreads) {
  const Points points = blobs(5, 9000, 2, 3);  // overlapping, several chunks
  const Clustering one = k_means(points, {.clusters = 7, .restarts = 1, .threads = 1});
  for (const int threads : {2, 7}) {
    const Clustering many = k_means(points, {.clusters = 7, .restarts = 1, .threads = threads});
    EXPECT_EQ(one.centers, many.centers);
    EXPECT_EQ(one.cluster_of, many.cluster_of);
    EXPECT_EQ(one.inertia_m2, many.inertia_m2);
  }
}

TEST(KMeans, DependsOnItsSeedAlone) {
  const Points points = blobs(1, 3000, 2, 4);
  const auto centers = [&](std::uint64_t seed) {
    return k_means(points, {.clusters = 6, .restarts = 1, .swaps = 0, .seed = seed}).centers;
  };
  EXPECT_EQ(centers(1), centers(1));
  EXPECT_NE(centers(1), centers(2));
}

TEST(KMeans, GivesEveryPointItsOwnClusterWhenThereAreAsMany) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  EXPECT_EQ(k_means(points, {.clusters = 4}).inertia_m2, 0);
}

TEST(KMeans, StandsMoreClustersThanDifferentPoints) {
  const Points points(10, Eigen::Vector3f(1, 2, 3));
  const Clustering found = k_means(points, {.clusters = 3});
  EXPECT_EQ(found.centers.size(), 3u);
  EXPECT_EQ(found.inertia_m2, 0);
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
