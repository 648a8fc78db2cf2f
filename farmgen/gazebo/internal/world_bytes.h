// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "gazebo/internal/load_world.h"

// Private to the library.
namespace plotscan::gazebo {

// A world's visuals as bytes, for another process of the same program.
std::string bytes_of(const WorldVisuals& world);

// The visuals back. Throws std::runtime_error where the bytes hold no visuals.
WorldVisuals world_visuals_of(std::string_view bytes);

}  // namespace plotscan::gazebo
