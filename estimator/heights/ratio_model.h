// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include <Eigen/Core>

#include "heights/calibration.h"
#include "heights/crop_model.h"
#include "heights/kriging.h"

namespace plotscan::heights {

// Heights' ratios to the canopy's top, for the plots of a field in the middle of their features; in
// the calibration's order.
struct FieldRatios {
  Eigen::VectorXd values;
  Eigen::VectorXd field_sds;   // of the field's ratios: what its kind of plants may change
  Eigen::VectorXd within_sds;  // of a plot's about the field's
};

// How heights follow from canopies, by a calibration's farms, for each crop by its own. Both
// standard deviations are those that were found on the farms most like the field.
class RatioModel {
 public:
  explicit RatioModel(const Calibration& calibration);

  // Of a field's scaled features (Calibration::scaled), its canopy's top, and its crop. Crops that
  // have no farm have a probability of 0.
  FieldRatios at(const Eigen::VectorXd& scaled, double top_m, const CropEvidence& crop) const;
  // The same as the regression alone has it: a mixture over the crops that it may be.
  Prediction mixture(const Eigen::VectorXd& scaled, double top_m,
                     const Eigen::VectorXd& crops) const;
  // How much less is known of a canopy with these scaled features, of its likeliest crop, than of
  // farms that were left out: over 1, it is farther from what is known than 95 of 100 of them were.
  double novelty(const Eigen::VectorXd& scaled, const Eigen::VectorXd& crops) const;

 private:
  // A crop that has farms.
  struct OfCrop {
    OfCrop(const Calibration& calibration, const Kernel& kernel);
    Eigen::VectorXd place(const Eigen::VectorXd& scaled) const;

    std::vector<CalibrationFarm> farms;
    Eigen::VectorXd weights;
    Kriging kriging;
    double usual_novelty;
  };

  const OfCrop& likeliest(const Eigen::VectorXd& crops) const;

  std::map<Eigen::Index, OfCrop> crops_;  // by its place in the calibration's
};

}  // namespace plotscan::heights
