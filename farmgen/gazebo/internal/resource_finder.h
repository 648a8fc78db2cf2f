// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plotscan::gazebo {

// Finds what the URIs of a world name: model://NAME/..., package://NAME/..., file://..., absolute
// paths, and paths relative to the file that names them.
class ResourceFinder {
 public:
  // model:// names are looked for in `first`, the world's folder, its models/, its parent, and in
  // the folders of SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_MODEL_PATH.
  ResourceFinder(const std::filesystem::path& world,
                 const std::vector<std::filesystem::path>& first);

  // The file or folder that `uri` names in the file `from`; absent where none exists.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::filesystem::path& from) const;
  // What find() looks for, in its order. None where a name leads out of its folder by "..".
  std::vector<std::filesystem::path> candidates(const std::string& uri,
                                                const std::filesystem::path& from) const;
  // ": not found; it would be ..., or ...", the end of a message.
  std::string not_found(const std::string& uri, const std::filesystem::path& from) const;

  const std::vector<std::filesystem::path>& folders() const { return folders_; }

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace plotscan::gazebo
