// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/k_means.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/random.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Points = std::span<const Eigen::Vector3f>;

// Sums are taken chunk by chunk and added in the chunks' order, whichever thread did which.
constexpr std::size_t kChunk = 8192;
// Iterations end when no centre moves farther: well below a voxel.
constexpr float kSettled_m = 1e-3f;
// Lloyd iterations by which a swap is judged.
constexpr int kSwapIterations = 5;
// A swap moves one of this many centres that cost least to remove.
constexpr std::size_t kCheapestCenters = 5;
// Bounds swaps x points x clusters of a restart: with a thousand clusters a swap takes 0.3 s.
constexpr double kMostSwapWork = 2e8;
constexpr std::size_t kSamplePointsPerCluster = 50;

// The centres by coordinate: the search for the nearest of them then runs on vector units.
struct CenterTable {
  Eigen::ArrayXf x, y, z;
  // Points closer to a centre than half its way to the next one have no nearer centre (Elkan, ICML
  // 2003, lemma 1). Slightly less than that, squared: distances are rounded.
  std::vector<float> own_m2;

  explicit CenterTable(const std::vector<Eigen::Vector3f>& centers) {
    const auto count = static_cast<Eigen::Index>(centers.size());
    const Eigen::Map<const Eigen::Matrix3Xf> all(centers.front().data(), 3, count);
    x = all.row(0);
    y = all.row(1);
    z = all.row(2);
    for (const Eigen::Vector3f& center : centers) own_m2.push_back(0.2499f * next_m2(center));
  }

  Eigen::ArrayXf squared_to(const Eigen::Vector3f& point) const {
    return (x - point.x()).square() + (y - point.y()).square() + (z - point.z()).square();
  }

 private:
  // The squared distance to the nearest other centre; 0 where one lies in the same place.
  float next_m2(const Eigen::Vector3f& center) const {
    Eigen::ArrayXf squared = squared_to(center);
    Eigen::Index own = 0;
    squared.minCoeff(&own);
    squared[own] = std::numeric_limits<float>::max();
    return squared.minCoeff();
  }
};

struct Nearest {
  std::uint32_t center = 0;
  float squared_m2 = 0;
};

Nearest nearest_center(const Eigen::Vector3f& point, const CenterTable& table,
                       Eigen::ArrayXf& squared) {
  squared = table.squared_to(point);
  const float least = squared.minCoeff();
  const auto first = std::find(squared.begin(), squared.end(), least);
  return {static_cast<std::uint32_t>(first - squared.begin()), least};
}

// The same, without a search where the centre of the round before has to be it.
Nearest nearest_center(const Eigen::Vector3f& point, std::uint32_t before, const CenterTable& table,
                       Eigen::ArrayXf& squared) {
  const Eigen::Array3f apart(table.x[before] - point.x(), table.y[before] - point.y(),
                             table.z[before] - point.z());
  // Added as squared_to adds, so that sums are the same to the bit.
  const float to_it_m2 = apart.x() * apart.x() + apart.y() * apart.y() + apart.z() * apart.z();
  if (to_it_m2 < table.own_m2[before]) return {before, to_it_m2};
  return nearest_center(point, table, squared);
}

// What one chunk of points adds to the centres.
struct ChunkSums {
  std::vector<Eigen::Vector3d> sum;
  std::vector<std::size_t> count;
  double inertia_m2 = 0;
  float farthest_m2 = -1;
  std::size_t farthest_point = 0;
};

ChunkSums assign_chunk(Points points, std::size_t first, std::size_t last, const CenterTable& table,
                       std::vector<std::uint32_t>& cluster_of) {
  const auto clusters = static_cast<std::size_t>(table.x.size());
  ChunkSums sums{.sum = std::vector<Eigen::Vector3d>(clusters, Eigen::Vector3d::Zero()),
                 .count = std::vector<std::size_t>(clusters, 0)};
  Eigen::ArrayXf squared(table.x.size());
  for (std::size_t i = first; i < last; ++i) {
    const Nearest nearest = nearest_center(points[i], cluster_of[i], table, squared);
    cluster_of[i] = nearest.center;
    sums.sum[nearest.center] += points[i].cast<double>();
    ++sums.count[nearest.center];
    sums.inertia_m2 += nearest.squared_m2;
    if (nearest.squared_m2 > sums.farthest_m2) {
      sums.farthest_m2 = nearest.squared_m2;
      sums.farthest_point = i;
    }
  }
  return sums;
}

// Assigns every point to its nearest centre and adds up the clusters.
ChunkSums assign_points(Points points, Clustering& clustering, tbb::task_arena& arena) {
  const CenterTable table(clustering.centers);
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  std::vector<ChunkSums> parts(chunks);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
      const std::size_t first = chunk * kChunk;
      parts[chunk] = assign_chunk(points, first, std::min(first + kChunk, points.size()), table,
                                  clustering.cluster_of);
    });
  });
  ChunkSums total = std::move(parts.front());
  for (std::size_t chunk = 1; chunk < chunks; ++chunk) {
    for (std::size_t i = 0; i < total.sum.size(); ++i) {
      total.sum[i] += parts[chunk].sum[i];
      total.count[i] += parts[chunk].count[i];
    }
    total.inertia_m2 += parts[chunk].inertia_m2;
    if (parts[chunk].farthest_m2 > total.farthest_m2) {
      total.farthest_m2 = parts[chunk].farthest_m2;
      total.farthest_point = parts[chunk].farthest_point;
    }
  }
  clustering.inertia_m2 = total.inertia_m2;
  return total;
}

// Moves the centres to their clusters' means. Returns the longest distance that one moved.
float move_centers(Points points, const ChunkSums& sums, std::vector<Eigen::Vector3f>& centers) {
  float longest_m = 0;
  bool refilled = false;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    Eigen::Vector3f moved = centers[i];
    if (sums.count[i] > 0) {
      moved = (sums.sum[i] / static_cast<double>(sums.count[i])).cast<float>();
    } else if (!refilled) {  // one a round, so that two empty clusters don't take the same point
      moved = points[sums.farthest_point];
      refilled = true;
    }
    longest_m = std::max(longest_m, (moved - centers[i]).norm());
    centers[i] = moved;
  }
  return longest_m;
}

Clustering lloyd(Points points, std::vector<Eigen::Vector3f> centers, int max_iterations,
                 tbb::task_arena& arena) {
  Clustering clustering{.centers = std::move(centers),
                        .cluster_of = std::vector<std::uint32_t>(points.size())};
  while (clustering.iterations < max_iterations) {
    ++clustering.iterations;
    const ChunkSums sums = assign_points(points, clustering, arena);
    if (move_centers(points, sums, clustering.centers) <= kSettled_m) break;
  }
  assign_points(points, clustering, arena);
  return clustering;
}

// The first centre uniform among the points, each next one with probability proportional to the
// squared distance to the nearest centre so far.
std::vector<Eigen::Vector3f> plus_plus_seeds(Points points, int clusters, RandomStream& random) {
  std::vector<Eigen::Vector3f> centers{points[random.below(points.size())]};
  std::vector<double> squared_m2(points.size(), std::numeric_limits<double>::infinity());
  while (centers.size() < static_cast<std::size_t>(clusters)) {
    double total = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double to_newest = (points[i] - centers.back()).squaredNorm();
      squared_m2[i] = std::min(squared_m2[i], to_newest);
      total += squared_m2[i];
    }
    double left = random.uniform() * total;
    std::size_t chosen = 0;
    while (chosen + 1 < points.size() && left >= squared_m2[chosen]) left -= squared_m2[chosen++];
    centers.push_back(points[chosen]);
  }
  return centers;
}

// How much each cluster's squares would grow if its points went to their second nearest centres.
std::vector<double> removal_costs(Points points, const Clustering& clustering) {
  const CenterTable table(clustering.centers);
  Eigen::ArrayXf squared(table.x.size());
  std::vector<double> costs(clustering.centers.size(), 0);
  for (const Eigen::Vector3f& point : points) {
    const Nearest first = nearest_center(point, table, squared);
    squared[first.center] = std::numeric_limits<float>::max();
    costs[first.center] += squared.minCoeff() - first.squared_m2;
  }
  return costs;
}

// A point drawn with probability proportional to its squared distance to its centre.
const Eigen::Vector3f& far_point(Points points, const Clustering& clustering,
                                 RandomStream& random) {
  double left = random.uniform() * clustering.inertia_m2;
  std::size_t chosen = 0;
  for (; chosen + 1 < points.size(); ++chosen) {
    left -= (points[chosen] - clustering.centers[clustering.cluster_of[chosen]]).squaredNorm();
    if (left < 0) break;
  }
  return points[chosen];
}

Clustering improved_by_swaps(Points points, Clustering clustering, int swaps, RandomStream& random,
                             tbb::task_arena& arena) {
  const std::size_t clusters = clustering.centers.size();
  const double work = static_cast<double>(points.size()) * static_cast<double>(clusters);
  swaps = clusters < 2 ? 0 : static_cast<int>(std::min<double>(swaps, kMostSwapWork / work));
  std::vector<std::size_t> order(clusters);
  std::vector<double> costs = removal_costs(points, clustering);
  for (int swap = 0; swap < swaps; ++swap) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t center) { return costs[center]; });
    std::vector<Eigen::Vector3f> centers = clustering.centers;
    centers[order[random.below(std::min(clusters, kCheapestCenters))]] =
        far_point(points, clustering, random);
    Clustering swapped = lloyd(points, std::move(centers), kSwapIterations, arena);
    if (swapped.inertia_m2 >= clustering.inertia_m2) continue;
    clustering = std::move(swapped);
    costs = removal_costs(points, clustering);
  }
  return clustering;
}

// A sample without replacement: the first places of a Fisher-Yates shuffle.
std::vector<Eigen::Vector3f> sample_of(Points points, std::size_t size, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> sample(points.begin(), points.end());
  if (size >= sample.size()) return sample;
  RandomStream random(seed, random_purpose("estimate/k-means sample"), 0);
  for (std::size_t i = 0; i < size; ++i) {
    std::swap(sample[i], sample[i + random.below(sample.size() - i)]);
  }
  sample.resize(size);
  return sample;
}

}  // namespace

Clustering k_means(Points points, const KMeansOptions& options) {
  check(options.clusters >= 1 && points.size() >= static_cast<std::size_t>(options.clusters),
        "k-means has at least one cluster and as many points as clusters");
  tbb::task_arena arena(options.threads);
  const std::size_t sample_size =
      std::max(options.sample_points, kSamplePointsPerCluster * options.clusters);
  const std::vector<Eigen::Vector3f> sample = sample_of(points, sample_size, options.seed);
  Clustering best;
  for (int restart = 0; restart < options.restarts; ++restart) {
    RandomStream random(options.seed, random_purpose("estimate/k-means"), restart);
    Clustering clustering =
        improved_by_swaps(sample,
                          lloyd(sample, plus_plus_seeds(sample, options.clusters, random),
                                options.max_iterations, arena),
                          options.swaps, random, arena);
    if (restart == 0 || clustering.inertia_m2 < best.inertia_m2) best = std::move(clustering);
  }
  return lloyd(points, std::move(best.centers), options.max_iterations, arena);
}

}  // namespace plotscan::methods::dhami2020
