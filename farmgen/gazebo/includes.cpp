// SPDX-License-Identifier: Apache-2.0
#include "gazebo/includes.h"

#include <algorithm>
#include <string_view>

#include <ignition/math/SemanticVersion.hh>
#include <sdf/parser.hh>
#include <tinyxml2.h>

#include "core/error.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

std::string trimmed(const char* text) {
  const std::string_view blanks = " \t\r\n";
  const std::string whole = text == nullptr ? "" : text;
  const auto begin = whole.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return whole.substr(begin, whole.find_last_not_of(blanks) - begin + 1);
}

// Of anything else libsdformat would print what it is not.
void require_sdf(const tinyxml2::XMLElement& root, const fs::path& file) {
  const std::string_view name = root.Name();
  if (name == "robot") return;  // URDF, which libsdformat reads, too
  if (name != "sdf")
    throw InputError(file, "is not an SDF file: its root is <" + std::string(name) + ">");
  const char* version = root.Attribute("version");
  if (version == nullptr) throw InputError(file, "<sdf> has no version");
  if (ignition::math::SemanticVersion(version) >
      ignition::math::SemanticVersion(sdf::SDF::Version())) {
    throw InputError(
        file, std::string("is SDF ") + version + "; up to " + sdf::SDF::Version() + " is read");
  }
}

class Follower {
 public:
  explicit Follower(const ResourceFinder& finder) : finder_(finder) {}

  void follow(const fs::path& file) {
    if (std::find(includes_.files.begin(), includes_.files.end(), file) != includes_.files.end())
      return;
    require_file(file);
    tinyxml2::XMLDocument document;
    if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
      throw InputError(file, static_cast<std::size_t>(std::max(1, document.ErrorLineNum())),
                       std::string("cannot be parsed as XML: ") + document.ErrorName());
    }
    require_sdf(*document.RootElement(), file);
    open_.push_back(file);
    walk(*document.RootElement(), file);
    open_.pop_back();
    includes_.files.push_back(file);
  }

  Includes take() { return std::move(includes_); }

 private:
  void walk(const tinyxml2::XMLElement& parent, const fs::path& file) {
    for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "include") follow_include(*child, file);
      if (name == "world" || name == "model") walk(*child, file);
    }
  }

  void follow_include(const tinyxml2::XMLElement& include, const fs::path& file) {
    const auto line = static_cast<std::size_t>(include.GetLineNum());
    const tinyxml2::XMLElement* element = include.FirstChildElement("uri");
    const std::string uri = trimmed(element == nullptr ? nullptr : element->GetText());
    if (uri.empty()) throw InputError(file, line, "<include> has no <uri>");
    const auto found = is_remote(uri) ? std::nullopt : finder_.find(uri, file);
    if (!found) throw InputError(file, line, "<include> " + finder_.not_found(uri, file));
    const auto [known, is_new] = includes_.by_uri.try_emplace(uri, *found);
    if (known->second != *found) {
      throw InputError(file, line,
                       "<include> " + uri + " means " + found->string() + " here and " +
                           known->second.string() + " elsewhere; name them model://");
    }
    const fs::path sdf = fs::is_directory(*found) ? sdf_of_model(*found, file, line) : *found;
    if (std::find(open_.begin(), open_.end(), sdf) != open_.end())
      throw InputError(file, line, "<include> " + uri + " goes round in a circle: " + circle(sdf));
    follow(sdf);
  }

  static fs::path sdf_of_model(const fs::path& folder, const fs::path& file, std::size_t line) {
    const std::string sdf = sdf::getModelFilePath(folder.string());
    if (sdf.empty()) {
      throw InputError(file, line,
                       "<include> leads to " + folder.string() +
                           ", which has no model.config that names an SDF file");
    }
    return fs::path(sdf).lexically_normal();
  }

  std::string circle(const fs::path& again) const {
    std::string way;
    for (auto file = std::find(open_.begin(), open_.end(), again); file != open_.end(); ++file)
      way += file->string() + " includes ";
    return way + again.string();
  }

  const ResourceFinder& finder_;
  std::vector<fs::path> open_;  // files being followed, each included by the one before it
  Includes includes_;
};

}  // namespace

Includes follow_includes(const fs::path& file, const ResourceFinder& finder) {
  Follower follower(finder);
  follower.follow(fs::absolute(file).lexically_normal());
  return follower.take();
}

}  // namespace plotscan::gazebo
