// SPDX-License-Identifier: Apache-2.0
// Points per second of the steps of dhami2020 that PCL has too, as a ratio to PCL's own, both in
// one run. See README.md.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/ml/kmeans.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include "comparison.h"
#include "core/error.h"
#include "methods/dhami2020/ground_plane.h"
#include "methods/dhami2020/k_means.h"
#include "methods/dhami2020/voxel_filter.h"
#include "record/open_source.h"
#include "scan/point.h"

namespace {

using namespace plotscan;
namespace dhami2020 = methods::dhami2020;

using Points = std::vector<Eigen::Vector3f>;
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr double kVoxel_m = 0.05;  // the method's defaults
constexpr double kTolerance_m = 0.05;
constexpr int kMostIterations = 1000;  // of RANSAC, as in dhami2020::find_ground_plane
constexpr float kSquare_m = 5;         // about a plot with its surroundings
constexpr int kSeed = 1;

PclCloud::Ptr pcl_cloud(std::span<const Eigen::Vector3f> points) {
  auto cloud = pcl::make_shared<PclCloud>();
  for (const Eigen::Vector3f& point : points) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

// Both sides have to come to the same.
void require_close(double ours, double pcl, const std::string& what) {
  check(std::abs(ours - pcl) <= 0.01 * pcl, fmt::format("{} {}, by PCL {}", ours, what, pcl));
}

PclCloud pcl_voxels(const PclCloud::ConstPtr& cloud) {
  pcl::VoxelGrid<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setLeafSize(kVoxel_m, kVoxel_m, kVoxel_m);
  PclCloud voxels;
  filter.filter(voxels);
  return voxels;
}

void add_voxel_filter(const Points& points) {
  const PclCloud::ConstPtr cloud = pcl_cloud(points);
  require_close(static_cast<double>(dhami2020::voxel_filter(points, kVoxel_m).size()),
                static_cast<double>(pcl_voxels(cloud).size()), "voxels");
  speed::add_benchmark(
      "voxel filter",
      {.ours = [&] { benchmark::DoNotOptimize(dhami2020::voxel_filter(points, kVoxel_m)); },
       .reference = [cloud] { benchmark::DoNotOptimize(pcl_voxels(cloud)); },
       .reference_name = "PCL's VoxelGrid",
       .items = "points",
       .count = static_cast<double>(points.size())});
}

// The points of each square of the field that has enough of them.
std::vector<std::vector<Eigen::Vector3d>> squares_of(const Points& points) {
  constexpr std::size_t kLeast = 1000;
  std::map<std::pair<float, float>, std::vector<Eigen::Vector3d>> squares;
  for (const Eigen::Vector3f& point : points)
    squares[{std::floor(point.x() / kSquare_m), std::floor(point.y() / kSquare_m)}].push_back(
        point.cast<double>());
  std::vector<std::vector<Eigen::Vector3d>> large;
  for (auto& [place, inside] : squares)
    if (inside.size() >= kLeast) large.push_back(std::move(inside));
  return large;
}

std::size_t pcl_inliers(const PclCloud::ConstPtr& cloud) {
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(kTolerance_m);
  segmentation.setMaxIterations(kMostIterations);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setInputCloud(cloud);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane;
  segmentation.segment(inliers, plane);
  return inliers.indices.size();
}

void add_plane(const Points& voxels) {
  const auto squares = squares_of(voxels);
  std::vector<PclCloud::ConstPtr> clouds;
  double points = 0;
  for (const std::vector<Eigen::Vector3d>& square : squares) {
    Points narrow;
    for (const Eigen::Vector3d& point : square) narrow.emplace_back(point.cast<float>());
    clouds.push_back(pcl_cloud(narrow));
    points += static_cast<double>(square.size());
  }
  const auto ours = [squares] {
    std::size_t inliers = 0;
    for (const auto& square : squares) {
      const auto plane = dhami2020::find_ground_plane(square, kTolerance_m);
      inliers += plane ? plane->inliers : 0;
    }
    return static_cast<double>(inliers);
  };
  const auto reference = [clouds] {
    std::size_t inliers = 0;
    for (const PclCloud::ConstPtr& cloud : clouds) inliers += pcl_inliers(cloud);
    return static_cast<double>(inliers);
  };
  require_close(ours(), reference(), "inliers");
  speed::add_benchmark("ground plane by RANSAC",
                       {.ours = [=] { benchmark::DoNotOptimize(ours()); },
                        .reference = [=] { benchmark::DoNotOptimize(reference()); },
                        .reference_name = "PCL's SACSegmentation",
                        .items = "points",
                        .count = points});
}

using PclNumbers = std::vector<std::vector<float>>;

pcl::Kmeans::Centroids pcl_centers(PclNumbers& numbers, int clusters) {
  pcl::Kmeans k_means(static_cast<unsigned>(numbers.size()), 3);
  k_means.setClusterSize(static_cast<unsigned>(clusters));
  k_means.setInputData(numbers);
  k_means.kMeans();
  return k_means.get_centroids();
}

// The sum of squares about the nearest centres.
double inertia_m2(const Points& points, const pcl::Kmeans::Centroids& centers) {
  double sum_m2 = 0;
  for (const Eigen::Vector3f& point : points) {
    float nearest_m2 = std::numeric_limits<float>::infinity();
    for (const std::vector<float>& center : centers)
      nearest_m2 =
          std::min(nearest_m2, (Eigen::Vector3f::Map(center.data()) - point).squaredNorm());
    sum_m2 += static_cast<double>(nearest_m2);
  }
  return sum_m2;
}

void add_k_means(const Points& voxels, int clusters) {
  const dhami2020::KMeansOptions options{.clusters = clusters, .seed = kSeed};
  PclNumbers numbers;
  for (const Eigen::Vector3f& voxel : voxels) numbers.push_back({voxel.x(), voxel.y(), voxel.z()});
  fmt::print(stderr, "k-means: {} voxels, {} clusters; sum of squares {:.0f} m2, PCL's {:.0f} m2\n",
             voxels.size(), clusters, dhami2020::k_means(voxels, options).inertia_m2,
             inertia_m2(voxels, pcl_centers(numbers, clusters)));
  speed::add_benchmark(
      "k-means",
      {.ours = [=] { benchmark::DoNotOptimize(dhami2020::k_means(voxels, options)); },
       .reference = [=]() mutable { benchmark::DoNotOptimize(pcl_centers(numbers, clusters)); },
       .reference_name = "PCL's Kmeans",
       .items = "points",
       .count = static_cast<double>(voxels.size())});
}

int run(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: method_speed SCAN PLOTS [--benchmark_...]\n";
    return 2;
  }
  Points points, crop;
  record::open_source(argv[1], {}).stream([&](std::span<const scan::LabelledPoint> piece) {
    for (const scan::LabelledPoint& point : piece) {
      points.emplace_back(point.x, point.y, point.z);
      if (point.label == scan::PointClass::crop) crop.push_back(points.back());
    }
  });
  add_voxel_filter(points);
  add_plane(dhami2020::voxel_filter(points, kVoxel_m));
  add_k_means(dhami2020::voxel_filter(crop, kVoxel_m), std::stoi(argv[2]));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return plotscan::speed::run_program("method_speed", run, argc, argv);
}
