// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "calibration/measured_field.h"
#include "heights/calibration.h"

namespace plotscan::calibration {

// Fits the weights of the plots' own features (ridge regression of a plot's ratios on its features,
// both as differences from its field's medians), and sets the spread that each farm's plots are
// left with. The larger that is, the less the farm counts; otherwise a lodged plot or a crease of
// the ground would outweigh all even fields. `fields` are those of the farms, in their order.
void fit_within(std::span<const MeasuredField> fields, heights::Calibration& calibration);

// Each height's spread over the field's plots that the calibration's weights leave, as a ratio.
Eigen::VectorXd spread_within(const MeasuredField& field, const heights::CalibrationFarm& farm,
                              const heights::Calibration& calibration);

}  // namespace plotscan::calibration
