// SPDX-License-Identifier: Apache-2.0 Replaces read_world.cpp in a build without libsdformat.
#include "core/error.h"
#include "gazebo/read_world.h"

namespace plotscan::gazebo {

StaticWorld read_world(const std::filesystem::path& file, const ReadWorldOptions& /*options*/) {
  throw InputError(
      file,
      "no SDF world can be read: Plotscan was built without libsdformat (Debian 12 has "
      "it as libsdformat-dev, Debian 13 has not); farms are exported all the same");
}

}  // namespace plotscan::gazebo
