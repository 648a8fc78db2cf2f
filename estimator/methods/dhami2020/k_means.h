// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace plotscan::methods::dhami2020 {

struct KMeansOptions {
  int clusters = 0;                  // k, at most the number of points
  int restarts = 3;                  // seedings, of which the tightest clustering is kept
  int swaps = 200;                   // tried in each restart; fewer where clusters are very many
  int max_iterations = 50;           // of Lloyd's algorithm, each time
  std::size_t sample_points = 3000;  // the search runs on a random sample of this size (at least
                                     // 50 points a cluster); the best goes on over all points
  std::uint64_t seed = 1;
  int threads = 1;
};

struct Clustering {
  std::vector<Eigen::Vector3f> centers;
  std::vector<std::uint32_t> cluster_of;  // by point
  double inertia_m2 = 0;                  // sum of squared distances to the centres
  int iterations = 0;                     // over all points
};

// k-means by Lloyd's algorithm from k-means++ seeds (Arthur and Vassilvitskii, 2007), improved by
// random swaps (Franti, "Efficiency of random swap clustering", 2018): a centre that costs little
// to remove goes to a far point, and stays there when the clustering gets tighter. Without them,
// Lloyd's algorithm stops with two plots in one cluster and two clusters in one plot. The same
// points, options and seed give the same clustering for any number of threads. A cluster that loses
// all its points takes the point farthest from its centre.
Clustering k_means(std::span<const Eigen::Vector3f> points, const KMeansOptions& options);

}  // namespace plotscan::methods::dhami2020
