// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gazebo/internal/load_world.h"

namespace sdf {
inline namespace v12 {
class Visual;
}
}  // namespace sdf

namespace plotscan::gazebo {

// The visual's geometry; absent where it has none. Throws InputError, naming the visual as `what`,
// when a size is not positive and finite, or the geometry is of a kind that is not read.
std::optional<ShapeSpec> shape_spec(const sdf::Visual& visual, const std::string& what,
                                    const std::filesystem::path& world);

}  // namespace plotscan::gazebo
