// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "calibration/measured_field.h"
#include "heights/calibration.h"

namespace plotscan::calibration {

// Chooses the covariances under which the farms' ratios and crops are most likely, and the weights
// of a plot's own features; finds what farms of other libraries and crops miss each farm by.
// Throws InputError unless there are two crops and two libraries of each.
heights::Calibration fit(std::span<const MeasuredField> fields);

// The calibration with more farms of its crops. The kernels of these crops' ratios are fitted
// again, and the new farms' errors are those of predictions from all farms of other libraries and
// crops; all else stays. Throws InputError on a farm of another crop.
heights::Calibration extended(const heights::Calibration& before,
                              std::span<const MeasuredField> fields);

}  // namespace plotscan::calibration
