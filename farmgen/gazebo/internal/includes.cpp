// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/includes.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <ignition/math/SemanticVersion.hh>
#include <sdf/parser.hh>
#include <tinyxml2.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/text.h"
#include "gazebo/internal/quiet.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

std::string text_of(const tinyxml2::XMLElement* element) {
  const char* text = element == nullptr ? nullptr : element->GetText();
  return std::string(without_blanks(text == nullptr ? "" : text, " \t\r\n"));
}

// libsdformat takes up to 2.5 MB and 20 ms a model, more the more there are.
constexpr std::uint64_t kMostModels = 10000;
constexpr std::size_t kDeepest = 64;  // files that include each other
// It takes some 25 bytes for one of the file.
constexpr std::uint64_t kMostBytes = 32'000'000;

// Whether it is made of whole numbers and dots, which is all that SemanticVersion survives.
bool is_version(std::string_view text) {
  int numbers = 1;
  for (;; ++numbers) {
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return numbers <= 3;
    if (text.front() != '.') return false;
    text.remove_prefix(1);
  }
}

bool is_too_new(const std::string& version) {
  return ignition::math::SemanticVersion(version) >
         ignition::math::SemanticVersion(sdf::SDF::Version());
}

// Refuses other files before libsdformat, which would print messages about them.
void require_sdf(const tinyxml2::XMLElement& root, const fs::path& file) {
  const std::string_view name = root.Name();
  if (name == "robot") return;  // URDF, which libsdformat reads, too
  if (name != "sdf") throw InputError(file, "is not an SDF file: its root is <{}>", name);
  const char* version = root.Attribute("version");
  if (version == nullptr) throw InputError(file, "<sdf> has no version");
  if (!is_version(version))
    throw InputError(file, "<sdf> has the version \"{}\", which is no number such as 1.9", version);
  if (is_too_new(version))
    throw InputError(file, "is SDF {}; up to {} is read", version, sdf::SDF::Version());
}

void load_xml(tinyxml2::XMLDocument& document, const fs::path& file, const std::string& refusal) {
  if (document.LoadFile(file.c_str()) == tinyxml2::XML_SUCCESS) return;
  throw InputError(file, static_cast<std::size_t>(std::max(1, document.ErrorLineNum())), "{}: {}",
                   refusal, document.ErrorName());
}

// libsdformat crashes on a description of a model that lacks something.
void require_config(const fs::path& config) {
  tinyxml2::XMLDocument document;
  load_xml(document, config, "cannot be parsed as XML");
  const tinyxml2::XMLElement* model = document.FirstChildElement("model");
  const tinyxml2::XMLElement* sdf = model == nullptr ? nullptr : model->FirstChildElement("sdf");
  if (sdf == nullptr) throw InputError(config, "has no <model> with an <sdf> that names its file");
  bool readable = false;
  for (; sdf != nullptr; sdf = sdf->NextSiblingElement("sdf")) {
    const auto line = static_cast<std::size_t>(sdf->GetLineNum());
    if (text_of(sdf).empty()) throw InputError(config, line, "<sdf> names no file");
    const char* version = sdf->Attribute("version");
    if (version == nullptr || !is_version(version))
      throw InputError(config, line, "<sdf> has no version that is a number such as 1.9");
    readable = readable || !is_too_new(version);
  }
  if (!readable)
    throw InputError(config, "names no file for SDF {} or an older one", sdf::SDF::Version());
}

class Follower {
 public:
  explicit Follower(const ResourceFinder& finder) : finder_(finder) {}

  // Returns how many models the file holds with all that it includes.
  std::uint64_t follow(const fs::path& file) {
    if (const auto known = models_.find(file); known != models_.end()) return known->second;
    require_file(file);
    if (fs::file_size(file) > kMostBytes)
      throw InputError(file, "has {} bytes; SDF is read up to {}", fs::file_size(file), kMostBytes);
    tinyxml2::XMLDocument document;
    load_xml(document, file, "cannot be parsed as XML, which SDF is");
    if (document.RootElement() == nullptr) throw InputError(file, "holds no XML element");
    require_sdf(*document.RootElement(), file);
    if (open_.size() == kDeepest)
      throw InputError(file, "is included by {} files in a row", kDeepest);
    open_.push_back(file);
    const std::uint64_t models = walk(*document.RootElement(), file);
    open_.pop_back();
    includes_.files.push_back(file);
    models_[file] = models;
    return models;
  }

  Includes take() { return std::move(includes_); }

 private:
  std::uint64_t walk(const tinyxml2::XMLElement& parent, const fs::path& file) {
    std::uint64_t models = 0;
    for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "include") models += follow_include(*child, file);
      if (name == "model") ++models;
      if (name == "world" || name == "model") models += walk(*child, file);
      if (models > kMostModels) {
        throw InputError(file, static_cast<std::size_t>(child->GetLineNum()),
                         "more than {} models with those of includes; join them, as farmgen export "
                         "--merge plot does",
                         kMostModels);
      }
    }
    return models;
  }

  std::uint64_t follow_include(const tinyxml2::XMLElement& include, const fs::path& file) {
    const auto line = static_cast<std::size_t>(include.GetLineNum());
    const std::string uri = text_of(include.FirstChildElement("uri"));
    if (uri.empty()) throw InputError(file, line, "<include> has no <uri>");
    const auto found = finder_.find(uri, file);
    if (!found) throw InputError(file, line, "<include> {}", finder_.not_found(uri, file));
    const auto [known, is_new] = includes_.by_uri.try_emplace(uri, *found);
    if (known->second != *found) {
      throw InputError(file, line,
                       "<include> {} means {} here and {} elsewhere; name them model://", uri,
                       found->string(), known->second.string());
    }
    const fs::path sdf = fs::is_directory(*found) ? sdf_of_model(*found, file, line) : *found;
    if (contains(open_, sdf))
      throw InputError(file, line, "<include> {} goes round in a circle: {}", uri, circle(sdf));
    return follow(sdf);
  }

  static fs::path sdf_of_model(const fs::path& folder, const fs::path& file, std::size_t line) {
    for (const char* config : {"model.config", "manifest.xml"}) {
      if (!fs::exists(folder / config)) continue;
      require_config(folder / config);
      break;
    }
    const std::string sdf = sdf::getModelFilePath(folder.string());
    if (sdf.empty()) {
      throw InputError(file, line,
                       "<include> leads to {}, which has no model.config that names an SDF file",
                       folder.string());
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
  std::map<fs::path, std::uint64_t> models_;  // of the files that were followed to their end
  Includes includes_;
};

}  // namespace

Includes follow_includes(const fs::path& file, const ResourceFinder& finder) {
  const Quiet quiet;
  Follower follower(finder);
  const std::uint64_t models = follower.follow(fs::absolute(file).lexically_normal());
  Includes includes = follower.take();
  includes.models = models;
  return includes;
}

}  // namespace plotscan::gazebo
