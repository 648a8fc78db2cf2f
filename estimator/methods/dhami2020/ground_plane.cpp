// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/ground_plane.h"

#include <vector>

#include <Eigen/Eigenvalues>
#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include "core/error.h"

namespace plotscan::methods::dhami2020 {
namespace {

// An upper bound: RANSAC stops when it has found a good plane with PCL's probability of 0.99.
constexpr int kMostIterations = 1000;

// PCL reports degenerate samples on the console; here they are an empty result.
void silence_pcl() {
  static const bool silenced = [] {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    return true;
  }();
  (void)silenced;
}

pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_cloud(std::span<const Eigen::Vector3d> points,
                                              const Eigen::Vector3d& origin) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f local = (point - origin).cast<float>();
    cloud->push_back({local.x(), local.y(), local.z()});
  }
  return cloud;
}

}  // namespace

GroundPlane least_squares_plane(std::span<const Eigen::Vector3d> points) {
  check(points.size() >= 3, "a plane needs three points");
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) centroid += point;
  centroid /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    covariance += (point - centroid) * (point - centroid).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);  // eigenvalues come sorted
  return {.centroid = centroid,
          .normal = normal.z() < 0 ? Eigen::Vector3d(-normal) : normal,
          .inliers = points.size()};
}

std::optional<GroundPlane> find_ground_plane(std::span<const Eigen::Vector3d> points,
                                             double tolerance_m) {
  if (points.size() < 3) return std::nullopt;
  silence_pcl();
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setDistanceThreshold(tolerance_m);
  segmentation.setMaxIterations(kMostIterations);
  segmentation.setInputCloud(pcl_cloud(points, points.front()));
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  segmentation.segment(inliers, coefficients);
  std::vector<Eigen::Vector3d> ground;
  for (const int index : inliers.indices) ground.push_back(points[index]);
  if (ground.size() < 3) return std::nullopt;
  return least_squares_plane(ground);
}

}  // namespace plotscan::methods::dhami2020
