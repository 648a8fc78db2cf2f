// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gazebo/internal/resource_finder.h"

namespace plotscan::gazebo {

// What the <include>s of a world lead to.
struct Includes {
  std::map<std::string, std::filesystem::path> by_uri;  // a file, or the folder of a model
  // The file itself and all that are read by includes, each once and behind those it includes.
  std::vector<std::filesystem::path> files;
  std::uint64_t models = 0;  // in the file with all that it includes
};

// Follows the includes of an SDF file, and of the files that it includes. libsdformat would follow
// a circle for ever, asks the network, and cannot say where it looked. Throws InputError (file,
// line) on such includes, on a missing one, on a file that is no SDF (or URDF), where two files
// mean different things by the same relative URI, which libsdformat cannot tell apart, and where
// there are more than 10,000 models in all, which libsdformat would need hours and the whole memory
// for.
Includes follow_includes(const std::filesystem::path& file, const ResourceFinder& finder);

}  // namespace plotscan::gazebo
