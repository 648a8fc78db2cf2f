// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace plotscan {

// The version of Plotscan, "major.minor.patch".
std::string version();

// XXH3 128-bit hash of a file's bytes as 32 hexadecimal digits: what `xxh128sum FILE` prints.
std::string file_hash(const std::filesystem::path& path);

// What a run was made of, so that it can be repeated. Nothing in it depends on the clock, the
// machine or the number of threads: the same input gives the same manifest.
struct Manifest {
  std::string command;  // "farmgen generate"
  std::uint64_t seed = 0;
  nlohmann::json options = nlohmann::json::object();
  // Files that the run read; they are hashed when the manifest is written.
  std::vector<std::filesystem::path> inputs = {};
  // The member "inputs" of an earlier run's manifest, written before this run's own inputs.
  nlohmann::json earlier_inputs = nlohmann::json::array();
  nlohmann::json results =
      nlohmann::json::object();  // counts worth knowing without opening the files
};

// Writes folder/manifest.json with format (core/format_version.h), version, command, seed, options,
// results, the inputs' names and hashes, and the hash of every other file below `folder` that is
// not hidden.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

// Throws InputError naming the file when a file below folder/`part` (such as "truth"; "" is the
// whole folder) no longer has the hash in the manifest.
void require_unchanged(const std::filesystem::path& folder, const std::string& part);

// Files and links below the folder that its manifest does not list, hidden ones included: sorted
// paths relative to the folder. Throws InputError as read_manifest does.
std::vector<std::filesystem::path> unlisted_files(const std::filesystem::path& folder);

// Throws InputError when the folder has no manifest.json that can be parsed, or one of a newer
// format.
nlohmann::json read_manifest(const std::filesystem::path& folder);

// Says that the cloud is not what the estimate in the folder was made from: no input in its
// manifest has the file's hash. Absent where one has, or where there is no manifest.
std::optional<std::string> other_cloud_note(const std::filesystem::path& estimate,
                                            const std::filesystem::path& cloud);

}  // namespace plotscan
