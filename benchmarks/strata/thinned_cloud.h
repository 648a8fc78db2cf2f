// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace plotscan::strata {

// A binary PCD 0.7 of x, y, z as floats, metres: a third of a simulated cloud's size, and all that
// an estimator reads of it. Throws WriteError when the file cannot be written.
void write_positions(const std::filesystem::path& file, const std::vector<Eigen::Vector3f>& points);

// Keeps at most `most` of the points, drawn by the seed, in their order.
void thin(std::vector<Eigen::Vector3f>& points, std::size_t most, std::uint64_t seed);

// Thins a cloud to about density_per_m2 points in the median square metre of its field and writes
// thinned.pcd beside it; returns that path, or the cloud's own where it is not denser. Clouds with
// the same number of points get the same draw. Throws InputError when the cloud cannot be read,
// WriteError when the file cannot be written.
std::filesystem::path thinned_cloud(const std::filesystem::path& cloud, double density_per_m2,
                                    int threads);

}  // namespace plotscan::strata
