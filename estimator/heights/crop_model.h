// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "heights/calibration.h"
#include "heights/kriging.h"

namespace plotscan::heights {

// Which crop a field is of.
struct CropEvidence {
  Eigen::VectorXd probabilities;  // in the order of the calibration's crops
  double novelty = 0;             // how little is known of such a canopy (CropModel::novelty)
  bool given = false;             // by the user, not derived from the canopy
};

// Which crop a canopy is of, by the calibration's farms: indicators of the crops (1 for farms of
// it, 0 for others) are kriged, as categorical indicator kriging does (Goovaerts, "Geostatistics
// for Natural Resources Evaluation", 1997; the book was not at hand). Every second farm is used:
// half of the farms recognise the crops of left-out libraries as well as all do, in an eighth of
// the time. Scores are kriged indicators in units of their standard deviation, so they count less
// for canopies of which little is known. A softmax (our choice) makes them probabilities; its
// sharpness was the likeliest for farms whose whole library was left out.
class CropModel {
 public:
  explicit CropModel(const Calibration& calibration);

  // Score of each crop, in the calibration's order, for a field's scaled features: the kriged
  // indicator (near 1 for its crop and near 0 for the others) over its standard deviation, up to a
  // scale that the crops share (Prediction::novelty). All are small for a canopy like none that is
  // known.
  Eigen::VectorXd scores(const Eigen::VectorXd& scaled) const;
  Eigen::VectorXd probabilities(const Eigen::VectorXd& scaled) const;
  // How little is known of such a canopy (Prediction::novelty); at least 0.1, as no canopy is known
  // without any doubt.
  double novelty(const Eigen::VectorXd& scaled) const;

 private:
  Eigen::VectorXd weights_;
  double sharpness_;
  Kriging indicators_;
};

Eigen::VectorXd softmax(const Eigen::VectorXd& scores, double sharpness);

// One row for each farm, one column for each crop: 1 for the farm's own crop, else 0.
Eigen::MatrixXd crop_indicators(const Calibration& calibration);

}  // namespace plotscan::heights
