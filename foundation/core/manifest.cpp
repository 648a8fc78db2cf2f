// SPDX-License-Identifier: Apache-2.0
#include "core/manifest.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <xxhash.h>

#include "core/error.h"
#include "core/format_version.h"
#include "core/json_text.h"
#include "core/text_file.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path file = fs::relative(entry.path(), folder);
    const bool hidden = file.begin()->string().starts_with(".");
    if (entry.is_regular_file() && !hidden && file != "manifest.json") files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string version() { return PLOTSCAN_VERSION; }

std::string file_hash(const fs::path& path) {
  require_file(path);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::ifstream in(path, std::ios::binary);
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(in.gcount()));
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state.get()));
  return fmt::format("{:02x}", fmt::join(canonical.digest, ""));
}

void write_manifest(const fs::path& folder, const Manifest& manifest) {
  nlohmann::ordered_json document;
  document["format"] = kFormat;
  document["plotscan"] = version();
  document["command"] = manifest.command;
  document["seed"] = manifest.seed;
  document["options"] = manifest.options;
  document["results"] = manifest.results;
  document["hash"] = "xxh128";
  document["inputs"] = manifest.earlier_inputs;
  for (const fs::path& input : manifest.inputs)
    document["inputs"].push_back({{"file", input.filename().string()}, {"hash", file_hash(input)}});
  document["outputs"] = nlohmann::json::array();
  for (const fs::path& file : files_below(folder)) {
    document["outputs"].push_back(
        {{"file", file.generic_string()}, {"hash", file_hash(folder / file)}});
  }
  write_text_file(folder / "manifest.json", json_lines(document));
}

nlohmann::json read_manifest(const fs::path& folder) {
  const fs::path path = folder / "manifest.json";
  if (!fs::exists(path))
    throw InputError(folder, "not a folder written by plotscan (it has no manifest.json)");
  nlohmann::json manifest = read_json(path);
  if (!manifest.is_object()) throw InputError(path, "not a manifest: a JSON object is expected");
  require_known_format(manifest, path);
  return manifest;
}

std::optional<std::string> other_cloud_note(const fs::path& estimate, const fs::path& cloud) {
  if (!fs::exists(estimate / "manifest.json")) return std::nullopt;
  const nlohmann::json inputs = read_manifest(estimate).value("inputs", nlohmann::json::array());
  const std::string hash = file_hash(cloud);
  const bool is_input = std::ranges::any_of(inputs, [&](const nlohmann::json& input) {
    return input.is_object() && input.value("hash", "") == hash;
  });
  if (is_input) return std::nullopt;
  return "The cloud " + cloud.string() +
         " is not the file that this estimate was made from (its manifest.json has another hash).";
}

void require_unchanged(const fs::path& folder, const std::string& part) {
  const nlohmann::json manifest = read_manifest(folder);
  try {
    for (const nlohmann::json& output : manifest.at("outputs")) {
      const std::string file = output.at("file");
      if (!part.empty() && !file.starts_with(part + "/")) continue;
      const fs::path path = path_inside(folder, file, folder / "manifest.json");
      if (file_hash(path) != output.at("hash").get<std::string>()) {
        throw InputError(path,
                         "was changed after plotscan wrote it (manifest.json holds another hash)");
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(folder / "manifest.json", "lists no outputs: {}", json_reason(error));
  }
}

std::vector<fs::path> unlisted_files(const fs::path& folder) {
  std::set<fs::path> listed = {"manifest.json"};
  const nlohmann::json manifest = read_manifest(folder);
  try {
    for (const nlohmann::json& output : manifest.value("outputs", nlohmann::json::array()))
      listed.insert(fs::path(output.at("file").get<std::string>()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(folder / "manifest.json", "lists no outputs: {}", json_reason(error));
  }
  std::vector<fs::path> unlisted;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    fs::path file = fs::relative(entry.path().parent_path(), folder) / entry.path().filename();
    file = file.lexically_normal();
    if (!listed.contains(file)) unlisted.push_back(std::move(file));
  }
  std::ranges::sort(unlisted);
  return unlisted;
}

}  // namespace plotscan
