// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/resource_finder.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "core/contains.h"
#include "core/error.h"
#include "core/text.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 4> kVariables = {"SDF_PATH", "GZ_SIM_RESOURCE_PATH",
                                                   "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"};

void add_folders_of(const char* variable, std::vector<fs::path>& folders) {
  const char* value = std::getenv(variable);
  if (value == nullptr) return;
  for (const std::string& folder : split(value, ':'))
    if (!folder.empty()) folders.emplace_back(folder);
}

// Whether a name leads out of the folder that it is looked for in.
bool leaves_folder(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  return path.is_absolute() || (!path.empty() && *path.begin() == "..");
}

// The rest of the URI behind the scheme, where it has that one.
std::optional<std::string> behind(const std::string& uri, std::string_view scheme) {
  if (!uri.starts_with(scheme)) return {};
  return uri.substr(scheme.size());
}

// Whether the URI leads to the network.
bool is_remote(const std::string& uri) {
  return uri.starts_with("http://") || uri.starts_with("https://") || uri.starts_with("fuel://");
}

}  // namespace

ResourceFinder::ResourceFinder(const fs::path& world, const std::vector<fs::path>& first)
    : folders_(first) {
  for (const fs::path& folder : first)
    if (!fs::is_directory(folder)) throw InputError(folder, "no such folder of resources");
  const fs::path folder = fs::absolute(world).lexically_normal().parent_path();
  folders_.insert(folders_.end(), {folder, folder / "models", folder.parent_path()});
  for (const char* variable : kVariables) add_folders_of(variable, folders_);
}

std::vector<fs::path> ResourceFinder::candidates(const std::string& uri,
                                                 const fs::path& from) const {
  const fs::path beside = fs::absolute(from).lexically_normal().parent_path();
  std::vector<fs::path> found;
  const auto in_folders = [&](const std::string& name) {
    if (leaves_folder(name)) return;
    for (const fs::path& folder : folders_) found.push_back(folder / name);
    // A model names its own files as model://ITSELF/..., wherever its folder lies.
    found.push_back(beside.parent_path() / name);
  };
  if (const auto path = behind(uri, "file://"); path && path->starts_with('/')) {
    found.emplace_back(*path);
  } else if (const auto name = path ? path : behind(uri, "model://")) {
    in_folders(*name);
  } else if (const auto package = behind(uri, "package://")) {
    in_folders(*package);
  } else if (uri.find("://") == std::string::npos) {
    found.push_back(beside / uri);  // the path itself where it is absolute
    if (!uri.starts_with('/')) in_folders(uri);
  }
  for (fs::path& path : found) path = path.lexically_normal();
  return found;
}

std::optional<fs::path> ResourceFinder::find(const std::string& uri, const fs::path& from) const {
  std::error_code error;
  for (const fs::path& path : candidates(uri, from))
    if (fs::exists(path, error)) return path;
  return {};
}

std::string ResourceFinder::not_found(const std::string& uri, const fs::path& from) const {
  if (is_remote(uri)) {
    return uri + " lies on the network, which is never asked: download the model, name it " +
           "model://NAME, and give the folder that holds it with --resource-path";
  }
  std::vector<std::string> names;
  for (const fs::path& path : candidates(uri, from))
    if (!contains(names, path.string())) names.push_back(path.string());
  if (names.empty() && (uri.starts_with("model://") || uri.starts_with("package://")))
    return uri + " leads out of the folders of models; name what lies in one";
  if (names.empty()) return uri + " has a scheme that is not known: model, package or file";
  return uri + " is found nowhere: not as " + joined(names, ", ") +
         "; give the folder that holds it with --resource-path";
}

}  // namespace plotscan::gazebo
