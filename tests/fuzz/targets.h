// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace plotscan::fuzz {

// What a target's files are made of: mutants of trees still parse, so that they come past the
// parser.
enum class Structure { bytes, yaml, xml, json };

// A reader of files from others.
struct Target {
  std::string name;
  std::string extension;  // of its files, with the dot
  Structure structure = Structure::bytes;
  std::function<void(const std::filesystem::path& file)> read;
};

// GoogleTest's name for one.
inline void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

const std::vector<Target>& targets();

// Has the target read a file of these bytes, alone in a folder of its own, which must exist. False
// where the reader refuses it, as it may (InputError); anything else that it throws goes on.
bool is_read(const Target& target, const std::string& bytes, const std::filesystem::path& folder);

}  // namespace plotscan::fuzz
