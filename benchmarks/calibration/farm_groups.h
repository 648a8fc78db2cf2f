// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "heights/calibration.h"

namespace plotscan::calibration {

// What is left out together when farms are predicted from the others.
enum class Group { farm, library, crop };

// The farms' numbers, group by group.
std::vector<std::vector<std::size_t>> groups_of(const heights::Calibration& calibration,
                                                Group group);

// The probabilities of the crops of which `others` has farms, with a sum of 1; a crop that was left
// out gets none.
Eigen::VectorXd known_crops(const heights::Calibration& others, Eigen::VectorXd probabilities);

}  // namespace plotscan::calibration
