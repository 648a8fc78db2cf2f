// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace plotscan::strata {

// A binary PCD 0.7 of x, y, z as floats, metres: a third of a simulated cloud's size, and all that
// an estimator reads of it. Throws WriteError when the file cannot be written.
void write_positions(const std::filesystem::path& file, const std::vector<Eigen::Vector3f>& points);

// The positions of a cloud in any format, in the file's order. Throws InputError when it cannot be
// read.
std::vector<Eigen::Vector3f> read_positions(const std::filesystem::path& cloud);

}  // namespace plotscan::strata
