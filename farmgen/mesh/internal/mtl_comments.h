// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace plotscan::mesh {

// MTL has no key for these; comments do not trouble its other readers.
inline constexpr const char* kReflectanceComment = "# reflectance_903nm";
inline constexpr const char* kCutoffComment = "# alpha_cutoff";

struct MtlComments {
  std::optional<float> reflectance;
  std::optional<float> cutoff;
};

// Reads such comments, by material, from the material libraries that an OBJ file names; empty for
// other files. Throws InputError, naming library and line, where the value is not a number in [0,
// 1].
std::map<std::string, MtlComments> read_mtl_comments(const std::filesystem::path& obj);

}  // namespace plotscan::mesh
