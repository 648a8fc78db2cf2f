// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include "core/range.h"

namespace plotscan {

// A YAML description. It knows where each value comes from (a line of the file or an override) and
// which keys a reader has asked for.
class YamlDocument {
 public:
  // A map of the document, and the keys that a reader asked it for, in that order.
  struct Reading {
    YAML::Node node;
    std::string path;  // dotted, "" for the document
    std::vector<std::string> asked = {};
    std::string scalar = {};  // the key of an entry that is a scalar, wrapped as a map
  };

  YamlDocument(std::filesystem::path file, std::vector<std::string> overrides)
      : file_(std::move(file)), overrides_(std::move(overrides)) {}

  // The reading of the map at the path, always the same object. It lives as long as the document.
  Reading& reading(const YAML::Node& node, const std::string& path);
  const std::deque<Reading>& readings() const { return readings_; }

  // Throws InputError: "file:line: message", or "--set key=value: message" if an override gave the
  // value at `path` or a map that holds it.
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& path,
                         const std::string& message) const;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::vector<std::string> overrides_;  // "key=value"
  std::deque<Reading> readings_ = {};
  std::unordered_map<std::string, std::size_t> place_of_path_ = {};
};

// One map of a YAML document, read key by key. Every error is an InputError that names the place,
// the key and what is allowed. A section remembers the keys that it was asked for: these are the
// known keys, and refuse_unread rejects all others. Internal to the library's .cpp files (it holds
// yaml-cpp's types).
class YamlSection {
 public:
  // Parses the file, checks its optional key "format" (core/format_version.h), and applies the
  // overrides ("dotted.path=value", list entries by index from 0; the value is YAML). The document
  // must be a map.
  static YamlSection load(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);
  // The same from a text in memory; errors call it `file`.
  static YamlSection parse(const std::string& text, const std::filesystem::path& file,
                           const std::vector<std::string>& overrides = {});

  // Throws InputError when any section read from this document holds a key that nobody asked for,
  // or a key twice. To be called when all has been read.
  void refuse_unread() const;
  // Throws InputError when the section holds a key other than these, or one of them twice. For keys
  // that are names themselves, such as those of a crop's parameters.
  void allow_only(const std::vector<std::string>& keys) const;
  bool has(const std::string& key) const;
  bool is_list(const std::string& key) const;
  bool is_map(const std::string& key) const;
  // The section's keys in the order of the file.
  std::vector<std::string> keys() const;

  // Readers of one key. Without a `fallback` the key is required.
  double number(const std::string& key, Range range, std::optional<double> fallback = {}) const;
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {}) const;
  std::uint64_t unsigned_integer(const std::string& key) const;
  std::string text(const std::string& key, const std::optional<std::string>& fallback = {}) const;
  // The index of the value in the names; it must be one of them.
  std::size_t choice(const std::string& key, const std::vector<std::string>& names,
                     std::optional<std::size_t> fallback = {}) const;
  // Two numbers: [first, second].
  std::pair<double, double> pair(const std::string& key, Range range,
                                 std::optional<std::pair<double, double>> fallback = {}) const;
  // `count` numbers: [first, second, ...].
  std::vector<double> numbers(const std::string& key, std::size_t count, Range range) const;
  YamlSection section(const std::string& key) const;
  // The entries of a list of 1 to `longest` maps. If `scalar_key` is given, an entry may also be a
  // scalar, which reads as a map with that one key.
  std::vector<YamlSection> list(const std::string& key, std::size_t longest,
                                const std::string& scalar_key = "") const;
  // Every key of the section with its value as text.
  std::map<std::string, std::string> texts() const;

  // Throws InputError at the line of the key, or of the section if the key is missing.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  // The same with a message that holds arguments: "has {} entries".
  template <class... Arguments>
  [[noreturn]] void fail(const std::string& key, fmt::format_string<Arguments...> message,
                         Arguments&&... arguments) const {
    fail(key, fmt::vformat(message, fmt::make_format_args(arguments...)));
  }
  const std::filesystem::path& file() const { return document_->file(); }

 private:
  YamlSection(std::shared_ptr<YamlDocument> document, const YAML::Node& node,
              const std::string& path)
      : document_(std::move(document)), reading_(&document_->reading(node, path)) {}

  // The value at the key, which counts as asked for from now on.
  YAML::Node value(const std::string& key) const;
  [[noreturn]] void fail_missing(const std::string& key) const;
  std::string path_of(const std::string& key) const;
  // Checks the document's key "format" and removes it.
  void take_format();
  // The scalar at the key; absent if the key is missing and not required.
  std::optional<std::string> scalar(const std::string& key, bool required) const;

  std::shared_ptr<YamlDocument> document_;
  YamlDocument::Reading* reading_;  // of the document
};

}  // namespace plotscan
