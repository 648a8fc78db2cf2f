// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "heights/calibration.h"
#include "heights/crop_model.h"
#include "heights/kriging.h"

namespace plotscan::heights {

// Ratios of heights to the canopy's top, in the calibration's order, for a plot with the median
// features of its field.
struct FieldRatios {
  Eigen::VectorXd values;
  Eigen::VectorXd field_sds;   // of the field's ratios: what its kind of plants may change
  Eigen::VectorXd within_sds;  // of a plot's about the field's
};

// Predicts plant heights from the canopy, for each crop from the calibration's farms of that crop.
// Both standard deviations are those found on the farms most like the field. A crop's regression is
// factorised when it is first needed: most fields need one. Threads may share a model.
class RatioModel {
 public:
  explicit RatioModel(const Calibration& calibration);

  // The ratios for a field's scaled features (Calibration::scaled), its canopy's top and its crop.
  // Crops that have no farm must have a probability of 0.
  FieldRatios at(const Eigen::VectorXd& scaled, double top_m, const CropEvidence& crop) const;
  // The regression's own prediction: a mixture over the possible crops.
  Prediction mixture(const Eigen::VectorXd& scaled, double top_m,
                     const Eigen::VectorXd& crops) const;
  // How unknown a canopy with these scaled features is, for its likeliest crop, against farms that
  // were left out: above 1, it is farther from what is known than 95 of 100 of those were.
  double novelty(const Eigen::VectorXd& scaled, const Eigen::VectorXd& crops) const;

 private:
  // A crop that has farms.
  class OfCrop {
   public:
    OfCrop(Calibration own, Kernel kernel);

    const std::vector<CalibrationFarm>& farms() const { return own_.farms; }
    double usual_novelty() const { return usual_novelty_; }
    Eigen::VectorXd place(const Eigen::VectorXd& scaled) const;
    const Kriging& kriging() const;

   private:
    Calibration own_;  // of its farms
    Kernel kernel_;
    double usual_novelty_;
    mutable std::once_flag asked_;
    mutable std::optional<Kriging> kriging_;
  };

  const OfCrop& likeliest(const Eigen::VectorXd& crops) const;

  std::map<Eigen::Index, OfCrop> crops_;  // by its place in the calibration's
};

}  // namespace plotscan::heights
