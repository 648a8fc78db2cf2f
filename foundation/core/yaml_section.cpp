// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_section.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/format_version.h"
#include "core/nearest_name.h"
#include "core/parse.h"
#include "core/printable.h"
#include "core/text.h"

namespace plotscan {
namespace {

std::string path_below(const std::string& path, const std::string& key) {
  if (path.empty() || key.empty()) return path + key;
  return path + "." + key;
}

// The node's child of that name or index; a map's child is made where it is missing. `path` leads
// to the node.
YAML::Node child(YAML::Node node, const std::string& path, const std::string& step,
                 const std::string& assignment) {
  if (node.IsSequence()) {
    const auto index = parsed<std::size_t>(step);
    if (!index || *index >= node.size()) {
      throw InputError(
          fmt::format("--set {}: \"{}\" is not an index of a list of {} entries (from 0)",
                      assignment, step, node.size()));
    }
    return node[*index];
  }
  if (node.IsScalar()) {
    throw InputError(fmt::format("--set {}: \"{}\" names a part of the plain value {}", assignment,
                                 step, node.Scalar()));
  }
  if (!path.empty() && parsed<std::size_t>(step)) {
    throw InputError(
        fmt::format("--set {}: there is no list {} of which {} would be an entry; set the whole "
                    "list, as in --set {}=[...]",
                    assignment, path, step, path));
  }
  return node[step];
}

void apply_override(const YAML::Node& root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw InputError(
        fmt::format("--set {}: expected key=value, as in terrain.relief_m=0.5", assignment));
  }
  YAML::Node node;
  node.reset(root);
  std::string path;
  for (const std::string& step : split(assignment.substr(0, equals), '.')) {
    if (step.empty())
      throw InputError(fmt::format("--set {}: the key has an empty part", assignment));
    node.reset(child(node, path, step, assignment));
    path = path_below(path, step);
  }
  try {
    node = YAML::Load(assignment.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("--set {}: {}", assignment, error.msg));
  }
}

// yaml-cpp needs some 70 bytes of memory for each byte of the file.
constexpr std::size_t kMostBytes = 4'000'000;

void require_size(std::uintmax_t bytes, const std::filesystem::path& file) {
  if (bytes <= kMostBytes) return;
  throw InputError(file, "has {} bytes; YAML is read up to {}", bytes, kMostBytes);
}

// Keeps where a document begins, and nothing of what it holds.
struct DocumentStart : YAML::EventHandler {
  YAML::Mark mark = {};
  void OnDocumentStart(const YAML::Mark& start) override { mark = start; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// YAML::LoadAll is not used: it takes a stray bracket or comma for an empty document again and
// again, until no memory is left.
void refuse_second_document(const std::string& text, const std::filesystem::path& file) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  DocumentStart document;
  if (!parser.HandleNextDocument(document) || !parser.HandleNextDocument(document)) return;
  const auto line = static_cast<std::size_t>(std::max(document.mark.line, 0) + 1);
  throw InputError(file, line, "begins a second YAML document (---); one is read");
}

YAML::Node parse_map(const std::string& text, const std::filesystem::path& file) {
  require_size(text.size(), file);
  require_utf8(text, file);
  try {
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw InputError(file, 1, "is not a map of keys to values");
    refuse_second_document(text, file);
    return root;
  } catch (const YAML::Exception& error) {
    throw InputError(file, static_cast<std::size_t>(error.mark.line + 1), "not YAML: {}",
                     error.msg);
  }
}

// A scalar wrapped in a map with that one key; other entries unchanged.
YAML::Node as_map(const YAML::Node& entry, const std::string& scalar_key) {
  if (!entry.IsScalar() || scalar_key.empty()) return entry;
  YAML::Node wrapped(YAML::NodeType::Map);
  wrapped[scalar_key] = entry;
  return wrapped;
}

std::string name_of(const YAML::Node& key) {
  return key.IsScalar() ? key.Scalar() : "(a list or map)";
}

void require_known(const YamlDocument& document, const YamlDocument::Reading& reading,
                   const std::vector<std::string>& known) {
  std::set<std::string> seen;
  for (const auto& entry : reading.node) {
    const std::string key = name_of(entry.first);
    const auto fail = [&](const std::string& message) {
      document.fail(entry.first.Mark(), path_below(reading.path, key), message);
    };
    if (!contains(known, key)) fail("is not a known key; known here are " + joined(known, ", "));
    if (!seen.insert(key).second) fail("is given twice");
  }
}

}  // namespace

YamlDocument::Reading& YamlDocument::reading(const YAML::Node& node, const std::string& path) {
  const auto [place, is_new] = place_of_path_.emplace(path, readings_.size());
  if (is_new) readings_.push_back({node, path});
  return readings_[place->second];
}

void YamlDocument::fail(const YAML::Mark& mark, const std::string& path,
                        const std::string& message) const {
  const std::string& text = path.empty() ? message : path + " " + message;
  for (auto assignment = overrides_.rbegin(); assignment != overrides_.rend(); ++assignment) {
    const std::string key = assignment->substr(0, assignment->find('='));
    const bool made = mark.is_null() && key.starts_with(path + ".");  // the file has no such part
    if (path == key || path.starts_with(key + ".") || made)
      throw InputError(fmt::format("--set {}: {}", *assignment, text));
  }
  throw InputError(file_, static_cast<std::size_t>(std::max(mark.line, 0) + 1), text);
}

YamlSection YamlSection::load(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides) {
  require_file(file);
  require_size(std::filesystem::file_size(file), file);
  return parse(read_text(file), file, overrides);
}

YamlSection YamlSection::parse(const std::string& text, const std::filesystem::path& file,
                               const std::vector<std::string>& overrides) {
  const YAML::Node root = parse_map(text, file);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  YamlSection document{std::make_shared<YamlDocument>(file, overrides), root, ""};
  document.take_format();
  return document;
}

void YamlSection::take_format() {
  const YAML::Node& root = reading_->node;
  const YAML::Node format = root["format"];
  if (!format) return;
  const auto number = format.IsScalar() ? parsed<std::uint64_t>(format.Scalar()) : std::nullopt;
  const std::string error = format_error(number ? nlohmann::json(*number) : nlohmann::json());
  if (!error.empty()) fail("format", error);
  reading_->node.remove("format");
}

std::string YamlSection::path_of(const std::string& key) const {
  return key == reading_->scalar ? reading_->path : path_below(reading_->path, key);
}

YAML::Node YamlSection::value(const std::string& key) const {
  std::vector<std::string>& asked = reading_->asked;
  if (!contains(asked, key)) asked.push_back(key);
  return std::as_const(reading_->node)[key];
}

// A value that is empty has the mark of what follows: it is blamed at its key.
void YamlSection::fail(const std::string& key, const std::string& message) const {
  const YAML::Node at = std::as_const(reading_->node)[key];
  YAML::Mark mark = at ? at.Mark() : reading_->node.Mark();
  if (at && at.IsNull()) {
    for (const auto& entry : reading_->node)
      if (name_of(entry.first) == key) mark = entry.first.Mark();
  }
  document_->fail(mark, path_of(key), message);
}

// If a key that nobody asked for is spelt almost like this one, the user probably meant this one.
void YamlSection::fail_missing(const std::string& key) const {
  std::vector<std::string> unread;
  for (const auto& entry : reading_->node) {
    const std::string other = name_of(entry.first);
    if (!contains(reading_->asked, other)) unread.push_back(other);
  }
  const auto misspelt = nearest_name(key, unread);
  for (const auto& entry : reading_->node) {
    if (misspelt && name_of(entry.first) == *misspelt)
      document_->fail(entry.first.Mark(), path_of(*misspelt),
                      "is not a known key, and " + key + " is missing");
  }
  fail(key, "is missing");
}

void YamlSection::refuse_unread() const {
  for (const YamlDocument::Reading& reading : document_->readings())
    require_known(*document_, reading, reading.asked);
}

void YamlSection::allow_only(const std::vector<std::string>& keys) const {
  require_known(*document_, *reading_, keys);
}

bool YamlSection::has(const std::string& key) const { return value(key).IsDefined(); }

bool YamlSection::is_list(const std::string& key) const {
  const YAML::Node found = value(key);
  return found && found.IsSequence();
}

bool YamlSection::is_map(const std::string& key) const {
  const YAML::Node found = value(key);
  return found && found.IsMap();
}

std::vector<std::string> YamlSection::keys() const {
  std::vector<std::string> all;
  for (const auto& entry : reading_->node) {
    all.push_back(entry.first.Scalar());
    value(all.back());
  }
  return all;
}

std::optional<std::string> YamlSection::scalar(const std::string& key, bool required) const {
  const YAML::Node at = value(key);
  if (!at.IsDefined()) {
    if (required) fail_missing(key);
    return {};
  }
  if (!at.IsScalar()) fail(key, at.IsNull() ? "has no value" : "is not a single value");
  return at.Scalar();
}

double YamlSection::number(const std::string& key, Range range,
                           std::optional<double> fallback) const {
  const auto text = scalar(key, !fallback);
  if (!text) return *fallback;
  const auto value = parsed<double>(*text);
  if (!value) fail(key, "\"{}\" is not a number; allowed are {}", *text, range.text());
  if (!range.contains(*value)) fail(key, "{} is not in {}", *text, range.text());
  return *value;
}

std::int64_t YamlSection::integer(const std::string& key, std::int64_t low, std::int64_t high,
                                  std::optional<std::int64_t> fallback) const {
  const auto text = scalar(key, !fallback);
  if (!text) return *fallback;
  const auto value = parsed<std::int64_t>(*text);
  if (!value) fail(key, "\"{}\" is not a whole number in [{}, {}]", *text, low, high);
  if (*value < low || *value > high) fail(key, "{} is not in [{}, {}]", *text, low, high);
  return *value;
}

std::uint64_t YamlSection::unsigned_integer(const std::string& key) const {
  const auto text = scalar(key, true);
  const auto value = parsed<std::uint64_t>(*text);
  if (!value) fail(key, "\"{}\" is not a whole number in [0, 18446744073709551615]", *text);
  return *value;
}

std::string YamlSection::text(const std::string& key,
                              const std::optional<std::string>& fallback) const {
  auto value = scalar(key, !fallback);
  if (!value) return *fallback;
  if (value->empty()) fail(key, "is empty");
  return *value;
}

std::size_t YamlSection::choice(const std::string& key, const std::vector<std::string>& names,
                                std::optional<std::size_t> fallback) const {
  const auto text = scalar(key, !fallback);
  if (!text) return *fallback;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found == names.end()) fail(key, "\"{}\" is not one of {}", *text, joined(names, ", "));
  return static_cast<std::size_t>(found - names.begin());
}

std::pair<double, double> YamlSection::pair(
    const std::string& key, Range range, std::optional<std::pair<double, double>> fallback) const {
  if (!has(key) && fallback) return *fallback;
  const std::vector<double> both = numbers(key, 2, range);
  return {both[0], both[1]};
}

std::vector<double> YamlSection::numbers(const std::string& key, std::size_t count,
                                         Range range) const {
  const YAML::Node list = value(key);
  if (!list.IsDefined()) fail_missing(key);
  const std::string counted = count == 2 ? "two" : std::to_string(count);
  const bool listed =
      list.IsSequence() && list.size() == count &&
      std::all_of(list.begin(), list.end(), [](const auto& entry) { return entry.IsScalar(); });
  if (!listed) fail(key, "is not a list of {} numbers in {}", counted, range.text());
  std::vector<double> all;
  std::vector<std::string> texts;
  for (const auto& entry : list) {
    const auto number = parsed<double>(entry.Scalar());
    texts.push_back(entry.Scalar());
    if (number && range.contains(*number)) all.push_back(*number);
  }
  if (all.size() < count) {
    fail(key, "[{}] is not {} numbers in {}", joined(texts, ", "),
         count == 2 ? "a pair of" : counted, range.text());
  }
  return all;
}

YamlSection YamlSection::section(const std::string& key) const {
  const YAML::Node map = value(key);
  if (!map.IsDefined()) fail_missing(key);
  if (!map.IsMap()) fail(key, "is not a map of keys to values");
  return {document_, map, path_of(key)};
}

std::vector<YamlSection> YamlSection::list(const std::string& key, std::size_t longest,
                                           const std::string& scalar_key) const {
  const YAML::Node list = value(key);
  if (!list.IsDefined()) fail_missing(key);
  if (!list.IsSequence() || list.size() == 0 || list.size() > longest)
    fail(key, "is not a list of 1 to {} entries", longest);
  std::vector<YamlSection> entries;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = path_below(path_of(key), std::to_string(i));
    const YAML::Node entry = as_map(list[i], scalar_key);
    if (!entry.IsMap()) document_->fail(entry.Mark(), path, "is not a map of keys to values");
    entries.push_back({document_, entry, path});
    if (list[i].IsScalar()) entries.back().reading_->scalar = scalar_key;
  }
  return entries;
}

std::map<std::string, std::string> YamlSection::texts() const {
  std::map<std::string, std::string> all;
  for (const std::string& key : keys()) all[key] = text(key);
  return all;
}

}  // namespace plotscan
