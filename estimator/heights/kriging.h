// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace plotscan::heights {

// A value and its standard deviation.
struct Prediction {
  double value = 0;
  double sd = 0;
};

// Covariance of two places a and b of d numbers each:
//   level^2 + linear^2 a.b / d + signal^2 exp(-|a - b|^2 / (2 d length^2))
struct Covariance {
  double signal = 0.1;
  double length = 1;
  double linear = 0.02;
};

// Gaussian process regression (Rasmussen and Williams 2006, section 2.2): a value from places where
// it is known. Far from all of them the standard deviation grows, which is why it was chosen.
class Kriging {
 public:
  // A row a place; its value, and the standard deviation of that value's own noise.
  Kriging(Eigen::MatrixXd places, Eigen::VectorXd values, std::vector<double> noise,
          const Covariance& covariance);

  // Of a new value there, its own noise included: as at the nearest known places.
  Prediction at(const Eigen::VectorXd& place) const;
  // Root mean square of numbers of the known places over those nearest to this one. With errors
  // over their standard deviations it says how much wider than these errors are there, as in
  // locally weighted conformal prediction (Lei et al. 2018, section 5.2).
  double local_spread(const Eigen::VectorXd& place, std::span<const double> numbers) const;
  // Each value from those of other groups alone (Rasmussen and Williams, equation 5.12, for
  // groups).
  std::vector<Prediction> without_own_group(std::span<const int> groups) const;

 private:
  double between(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

  Eigen::MatrixXd places_;
  Eigen::VectorXd values_;
  std::vector<double> noise_;
  Covariance covariance_;
  double center_ = 0;
  Eigen::MatrixXd inverse_;
  Eigen::VectorXd weights_;
};

}  // namespace plotscan::heights
