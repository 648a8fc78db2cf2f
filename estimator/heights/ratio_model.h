// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "heights/calibration.h"
#include "heights/kriging.h"

namespace plotscan::heights {

// Heights' ratios to the canopy's top, for the plots of a field in the middle of their features; in
// the calibration's order.
struct FieldRatios {
  Eigen::VectorXd values;
  Eigen::VectorXd field_sds;   // of the field's ratios: what its kind of plants may change
  Eigen::VectorXd within_sds;  // of a plot's about the field's
};

// How heights follow from canopies, by a calibration's farms. Both standard deviations are those
// that were found on the farms most like the field.
class RatioModel {
 public:
  explicit RatioModel(const Calibration& calibration);

  // Of a field's place (Calibration::place) and its canopy's top.
  FieldRatios at(const Eigen::VectorXd& place, double top_m) const;
  // How much less is known of a canopy there than of farms that were left out: over 1, it is
  // farther from what is known than 95 of 100 of them were.
  double unlike(const Eigen::VectorXd& place) const;

 private:
  Kriging kriging_;
  Eigen::MatrixXd surprises_;  // a row a farm, by the others: errors over standard deviations
  Eigen::MatrixXd within_;     // a row a farm
  double usual_unlike_ = 1;
};

}  // namespace plotscan::heights
