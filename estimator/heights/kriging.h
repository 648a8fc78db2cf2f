// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace plotscan::heights {

// Covariance of two places a and b, as a share of what a value varies by:
//   exp(-|a - b|^2 / 2) + linear^2 a.b + level^2
// and `noise`, the standard deviation of a known value's own noise, in the same share.
struct Covariance {
  double linear = 0.7;
  double noise = 0.3;
};

// Several values of one place, and by how much what varies about them does so: a value's standard
// deviation is its spread times its own scale. `novelty` is the part of it that is not noise: 0 in
// the middle of what is known, 1 and more where nothing is.
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
  // A row a place; a row of its values; how much noisier than usual its values are.
  Kriging(Eigen::MatrixXd places, const Eigen::MatrixXd& values, std::vector<double> noise,
          const Covariance& covariance);

  Eigen::VectorXd values_at(const Eigen::VectorXd& place) const;
  // Of new values there, their own noise, so much more than usual, included.
  Prediction at(const Eigen::VectorXd& place, double noise) const;
  // Of the noiseless value alone: Prediction::novelty.
  double novelty(const Eigen::VectorXd& place) const;
  // Of this place to each known one.
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

// exp(-|a - b|^2 / 2) of all pairs of places, and their covariances without noise; a row a place.
Eigen::MatrixXd squared_exponentials_of(const Eigen::MatrixXd& places);
Eigen::MatrixXd covariances_of(const Eigen::MatrixXd& places, double linear);

// How much noisier the ratios of a canopy this high are than a very high one's: errors are in
// proportion to the canopy above this height, and the same in metres below it. Half a metre did
// best of 0, 0.25 and 0.5 m on farms left out.
double relative_noise(double top_m);

}  // namespace plotscan::heights
