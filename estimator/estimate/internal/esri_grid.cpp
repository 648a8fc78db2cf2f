// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/esri_grid.h"

#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/contains.h"
#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"

namespace plotscan::estimate {
namespace {

constexpr double kMostNodes = 1e9;      // along a side
constexpr double kFarthest_m = 1e9;     // of a coordinate
constexpr double kUsualNoData = -9999;  // of a file that names none

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// A file's words with their lines.
class Words {
 public:
  Words(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {}

  // "" at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  // Whether the next word begins with a letter; the word is not consumed.
  bool letter_follows() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    // nan and inf are no numbers of this format: they are taken for a header's word, and refused.
    return at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0;
  }
  // The next word, which must be a finite number.
  double number(const std::string& what) {
    const std::string_view word = without_plus(next());
    const auto value = parsed<double>(word);
    if (!value || !std::isfinite(*value)) {
      fail(what + (word.empty() ? " is missing"
                                : " is '" + std::string(word.substr(0, 20)) + "', not a number"));
    }
    return *value;
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, line_, what); }

 private:
  const std::filesystem::path& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

class Header {
 public:
  explicit Header(Words& words) : words_(words) {
    while (words.letter_follows()) {
      std::string key = lower_case(words.next().substr(0, 20));
      if (!contains(kKeys, key)) {
        words.fail("'" + key + "' is no word of an ESRI ASCII grid's header");
      }
      if (values_.contains(key)) words.fail(key + " stands there twice");
      values_[key] = words.number(key);
    }
  }
  std::optional<double> find(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }
  double value(const std::string& key, double low, double high) const {
    const std::optional<double> value = find(key);
    if (!value) words_.fail("the header has no " + key);
    if (!(*value >= low && *value <= high)) words_.fail(key + " is out of range");
    return *value;
  }
  int nodes(const std::string& key) const {
    const double count = value(key, 2, kMostNodes);
    if (count != std::floor(count)) words_.fail(key + " is not a whole number");
    return static_cast<int>(count);
  }
  // Coordinate of the first node along an axis, 'x' or 'y'.
  double first(char axis, double cell) const {
    const std::string center = std::string(1, axis) + "llcenter";
    if (find(center)) return value(center, -kFarthest_m, kFarthest_m);
    return value(std::string(1, axis) + "llcorner", -kFarthest_m, kFarthest_m) + cell / 2;
  }

 private:
  static constexpr std::array<std::string_view, 8> kKeys = {"ncols",     "nrows",       "xllcorner",
                                                            "yllcorner", "xllcenter",   "yllcenter",
                                                            "cellsize",  "nodata_value"};
  Words& words_;
  std::map<std::string, double> values_;
};

}  // namespace

EsriGrid read_esri_grid(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  Words words(path, text);
  const Header header(words);
  EsriGrid grid{.cell = header.value("cellsize", 1e-3, 1e4),
                .columns = header.nodes("ncols"),
                .rows = header.nodes("nrows")};
  grid.first = {header.first('x', grid.cell), header.first('y', grid.cell)};
  const double no_data = header.find("nodata_value").value_or(kUsualNoData);
  // A value takes two characters at least: no more is set aside than the file can hold.
  const auto nodes = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  if (nodes > text.size()) words.fail("has fewer values than ncols times nrows");
  grid.values.resize(nodes);
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double value = words.number("a value of the grid");
      grid.values[static_cast<std::size_t>(row) * grid.columns + column] =
          value == no_data ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value);
    }
  }
  if (!words.next().empty()) words.fail("has more values than ncols times nrows");
  return grid;
}

}  // namespace plotscan::estimate
