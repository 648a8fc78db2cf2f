// SPDX-License-Identifier: Apache-2.0
#pragma once

// How smooth the few returns of a small place are.

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace plotscan::plots {

// Returns of a patch as if they lay on a plane; metres, from somewhere near.
class Patch {
 public:
  void add(const Eigen::Vector3f& point) {
    ++count_;
    sum_ += point;
    products_ += point * point.transpose();
  }
  float count() const { return count_; }
  float mean_height() const { return sum_.z() / std::max(1.0F, count_); }
  // Standard deviation of the returns about the best plane through them, of any orientation.
  double sd_about_plane() const {
    const Eigen::Matrix3d covariance =
        (products_ - sum_ * sum_.transpose() / count_).cast<double>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, axes.eigenvalues()(0)) / std::max(1.0, count_ - 3.0));
  }

 private:
  float count_ = 0;
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f products_ = Eigen::Matrix3f::Zero();
};

}  // namespace plotscan::plots
