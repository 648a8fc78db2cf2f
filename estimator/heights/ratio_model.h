// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "heights/calibration.h"
#include "heights/kriging.h"

namespace plotscan::heights {

// A height's ratio to the canopy's top, for the plots of a field in the middle of their features.
struct FieldRatio {
  double value = 0;
  double field_sd = 0;   // of the field's ratio: what its kind of plants may change
  double within_sd = 0;  // of a plot's about the field's
};

// How one height follows from canopies, by a calibration's farms. Both standard deviations are
// those that were found on the farms most like the field.
class RatioModel {
 public:
  RatioModel(const Calibration& calibration, const std::string& height);

  // For scaled features of a field.
  FieldRatio at(const Eigen::VectorXd& place) const;

 private:
  Kriging kriging_;
  std::vector<double> surprises_;  // of each farm by the others: error over standard deviation
  std::vector<double> within_;     // of each farm
};

}  // namespace plotscan::heights
