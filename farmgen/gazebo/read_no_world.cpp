// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "gazebo/read_world.h"

namespace plotscan::gazebo {

// Replaces read_world.cpp's in a build without libsdformat.
StaticWorld read_world(const std::filesystem::path& file, const ReadWorldOptions& /*options*/) {
  throw InputError(
      file,
      "no SDF world can be read: Plotscan was built without libsdformat (Debian 12 has "
      "it as libsdformat-dev, Debian 13 has not); farms are exported all the same");
}

}  // namespace plotscan::gazebo
