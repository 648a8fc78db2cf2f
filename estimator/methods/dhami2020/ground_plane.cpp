// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/ground_plane.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include "core/error.h"
#include "core/list_of.h"

namespace plotscan::methods::dhami2020 {
namespace {

// An upper bound: RANSAC stops when it has found a good plane with PCL's probability of 0.99.
constexpr int kMostIterations = 1000;

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

// PCL's plane, whose inliers are counted in vector instructions over a cloud's coordinates one by
// one: that is most of RANSAC's time. The sums are in the order of PCL's own, which finds the same.
class PlaneModel : public pcl::SampleConsensusModelPlane<pcl::PointXYZ> {
 public:
  explicit PlaneModel(const PclCloud::ConstPtr& cloud)
      : SampleConsensusModelPlane(cloud),
        coordinates_(static_cast<Eigen::Index>(cloud->size()), 3) {
    for (Eigen::Index i = 0; i < coordinates_.rows(); ++i)
      coordinates_.row(i) = (*cloud)[static_cast<std::size_t>(i)].getArray3fMap().transpose();
  }

  std::size_t countWithinDistance(const Eigen::VectorXf& plane, double threshold) const override {
    if (!isModelValid(plane)) return 0;
    // The least float that is no less, so that floats can be compared.
    auto limit = static_cast<float>(threshold);
    if (limit < threshold) limit = std::nextafter(limit, std::numeric_limits<float>::infinity());
    const auto x = coordinates_.col(0), y = coordinates_.col(1), z = coordinates_.col(2);
    int count = 0;
    for (Eigen::Index i = 0; i < coordinates_.rows(); ++i) {
      const float distance = (plane[0] * x[i] + plane[2] * z[i]) + (plane[1] * y[i] + plane[3]);
      count += static_cast<int>(std::abs(distance) < limit);
    }
    return static_cast<std::size_t>(count);
  }

 private:
  Eigen::ArrayX3f coordinates_;
};

// PCL reports degenerate samples on the console; here they are an empty result.
void silence_pcl() {
  static const bool silenced = [] {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    return true;
  }();
  (void)silenced;
}

PclCloud::Ptr pcl_cloud(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& origin) {
  auto cloud = pcl::make_shared<PclCloud>();
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
  const auto model = pcl::make_shared<PlaneModel>(pcl_cloud(points, points.front()));
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, tolerance_m);
  ransac.setMaxIterations(kMostIterations);
  if (!ransac.computeModel()) return std::nullopt;
  pcl::Indices inliers;
  Eigen::VectorXf found, refined;
  ransac.getInliers(inliers);
  ransac.getModelCoefficients(found);
  model->optimizeModelCoefficients(inliers, found, refined);
  model->selectWithinDistance(refined, tolerance_m, inliers);
  const std::vector<Eigen::Vector3d> ground =
      list_of(inliers, [&](int index) { return points[index]; });
  if (ground.size() < 3) return std::nullopt;
  return least_squares_plane(ground);
}

}  // namespace plotscan::methods::dhami2020
