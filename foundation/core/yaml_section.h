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

#include <yaml-cpp/yaml.h>

#include "core/range.h"

namespace plotscan {

// A description: where its values come from, a line of the file or an override, and which of its
// keys were asked for.
class YamlDocument {
 public:
  // A map of the document, and the keys that a reader asked it for, in that order.
  struct Reading {
    YAML::Node node;
    std::string path;  // dotted, "" for the document
    std::vector<std::string> asked = {};
  };

  YamlDocument(std::filesystem::path file, std::vector<std::string> overrides)
      : file_(std::move(file)), overrides_(std::move(overrides)) {}

  // The reading of the map at the path: the same each time. It lives as long as the document.
  Reading& reading(const YAML::Node& node, const std::string& path);
  const std::deque<Reading>& readings() const { return readings_; }

  // Throws InputError: "file:line: message", or "--set key=value: message" where an override gave
  // the value at `path` (or what holds it).
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
// known ones, and refuse_unread refuses the others. Internal to the library's .cpp files (it holds
// yaml-cpp's types).
class YamlSection {
 public:
  // Parses the file, whose key "format" may say which it is of (core/format.h), and applies the
  // overrides ("dotted.path=value", list entries by index from 0; the value is YAML). The document
  // must be a map.
  static YamlSection load(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);
  // The same from a text; errors name it as `file`.
  static YamlSection parse(const std::string& text, const std::filesystem::path& file,
                           const std::vector<std::string>& overrides = {});

  // Throws when a section that was read of the document, whichever it is, holds a key that nobody
  // asked for, or one twice. To be called once all is read.
  void refuse_unread() const;
  // Throws when the section holds a key other than these, or one of them twice: for keys that are
  // names of something, as of a crop's parameters.
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
  // One of the names; its index.
  std::size_t choice(const std::string& key, const std::vector<std::string>& names,
                     std::optional<std::size_t> fallback = {}) const;
  // Two numbers: [first, second].
  std::pair<double, double> pair(const std::string& key, Range range,
                                 std::optional<std::pair<double, double>> fallback = {}) const;
  // `count` numbers: [first, second, ...].
  std::vector<double> numbers(const std::string& key, std::size_t count, Range range) const;
  YamlSection section(const std::string& key) const;
  // The entries of a list, each of which is a map, or a scalar when `scalar_key` is given (then it
  // reads as a map with that one key).
  std::vector<YamlSection> list(const std::string& key, std::size_t longest,
                                const std::string& scalar_key = "") const;
  // Every key of the section with its text.
  std::map<std::string, std::string> texts() const;

  // Throws InputError about a key of this section (or, where it is missing, about the section).
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  const std::filesystem::path& file() const { return document_->file(); }

 private:
  YamlSection(std::shared_ptr<YamlDocument> document, const YAML::Node& node,
              const std::string& path)
      : document_(std::move(document)), reading_(&document_->reading(node, path)) {}

  // The value at the key, which is known from here on.
  YAML::Node value(const std::string& key) const;
  [[noreturn]] void fail_missing(const std::string& key) const;
  std::string path_of(const std::string& key) const;
  // Checks the document's key "format" and removes it.
  void take_format();
  // The scalar at the key; nothing where the key is missing and need not be there.
  std::optional<std::string> scalar(const std::string& key, bool required) const;

  std::shared_ptr<YamlDocument> document_;
  YamlDocument::Reading* reading_;  // of the document
};

}  // namespace plotscan
