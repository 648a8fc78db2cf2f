// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Diffuse reflectance at 903 nm, in [0, 1], where nothing else is stated (docs/reflectance.md has
// the sources).
inline constexpr float kSoilReflectance = 0.30F;
inline constexpr float kLeafReflectance =
    0.45F;  // and of a plant's surface whose name says nothing

// Reflectance by the words in a material's name ("leaf.001", "old_leaf", "dry_stem"), from the
// table in docs/reflectance.md. Absent where the name has none of them.
std::optional<float> reflectance_by_name(std::string_view name);

// Whether the material's name has "leaf", "leaves" or "blade", in capitals or not.
bool names_leaf(std::string_view name);

// The reflectance that the material states, else reflectance_by_name.
std::optional<float> reflectance_of(const Material& material);

}  // namespace plotscan::mesh
