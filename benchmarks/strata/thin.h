// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace plotscan::strata {

// So many of the points, drawn by the seed, in their order; all where there are no more.
void thin(std::vector<Eigen::Vector3f>& points, std::size_t most, std::uint64_t seed);

// The cloud beside itself as thinned.pcd, returns drawn until so many are left in the median square
// metre of its field; the cloud itself where it has no more. The draw is the same for each cloud of
// as many points. Throws InputError when the cloud cannot be read, WriteError when the file cannot
// be written.
std::filesystem::path thinned_cloud(const std::filesystem::path& cloud, double density_per_m2,
                                    int threads);

}  // namespace plotscan::strata
