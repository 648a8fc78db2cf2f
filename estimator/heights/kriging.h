// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace plotscan::heights {

// Covariance of two places a and b, as a share of a value's variance:
//   exp(-|a - b|^2 / 2) + linear^2 a.b + 10
// (the 10 leaves the values' common level open), and `noise`, the standard deviation of a known
// value's own noise, in the same share.
struct Covariance {
  double linear = 0.7;
  double noise = 0.3;
};

// Several predicted values at one place, and their uncertainty: a value's standard deviation is the
// common spread times the value's own scale. `novelty` is the part of the spread that is not noise:
// 0 amid known places, 1 and more where nothing is known.
struct Prediction {
  Eigen::VectorXd values;
  Eigen::VectorXd sds;
  double novelty = 0;
};

// Gaussian process regression (Rasmussen and Williams 2006, section 2.2) of several values that
// share one covariance up to a scale, so that one factorisation serves all of them. Far from all
// known places the standard deviation grows, which is why it was chosen.
class Kriging {
 public:
  // One row for each place in `places` and in `values`; `noise` is how many times noisier than
  // usual a place's values are.
  Kriging(Eigen::MatrixXd places, const Eigen::MatrixXd& values, std::vector<double> noise,
          const Covariance& covariance);

  Eigen::VectorXd values_at(const Eigen::VectorXd& place) const;
  // Prediction of new values at a place, with their own noise, `noise` times the usual one.
  Prediction at(const Eigen::VectorXd& place, double noise) const;
  // Prediction::novelty at a place: the uncertainty of the value without noise.
  double novelty(const Eigen::VectorXd& place) const;
  // Squared distances from this place to each known one.
  Eigen::VectorXd squared_distances(const Eigen::VectorXd& place) const;

 private:
  Eigen::VectorXd covariances(const Eigen::VectorXd& place) const;
  double noise_variance(double noise) const;

  Eigen::MatrixXd places_;
  Eigen::MatrixXd values_;
  std::vector<double> noise_;
  Covariance covariance_;
  Eigen::RowVectorXd center_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd weights_;
  Eigen::VectorXd scales_;  // what each value varies by
};

// exp(-|a - b|^2 / 2) of all pairs of places, and their covariances without noise; `places` has one
// row for each place.
Eigen::MatrixXd squared_exponentials_of(const Eigen::MatrixXd& places);
Eigen::MatrixXd covariances_of(const Eigen::MatrixXd& places, double linear);

// How many times noisier the ratios of a canopy of height top_m are than those of a very high one.
// Errors are proportional to the height of canopies well above 0.5 m, and constant in metres well
// below. Of 0, 0.25 and 0.5 m, half a metre did best on left-out farms.
double relative_noise(double top_m);

}  // namespace plotscan::heights
