// SPDX-License-Identifier: Apache-2.0
#include "scan/internal/wkt.h"

#include <cctype>

#include "core/contains.h"

namespace plotscan::scan {
namespace {

constexpr int kDeepest = 32;  // levels of nested nodes; real ones have 8

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  std::optional<WktNode> node(int depth = 0) {
    WktNode node{.keyword = word()};
    if (depth == kDeepest || node.keyword.empty() || !take("[(")) return std::nullopt;
    do {
      if (!argument(node, depth)) return std::nullopt;
    } while (take(","));
    return take("])") ? std::optional(node) : std::nullopt;
  }

 private:
  bool argument(WktNode& node, int depth) {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '"') return quoted(node);
    const std::size_t begin = at_;
    const std::string bare = word();
    skip_blanks();
    if (bare.empty()) return false;
    if (at_ == text_.size() || (text_[at_] != '[' && text_[at_] != '(')) {
      node.values.push_back(bare);
      return true;
    }
    at_ = begin;
    std::optional<WktNode> child = this->node(depth + 1);
    if (child) node.children.push_back(std::move(*child));
    return child.has_value();
  }
  // Reads a quoted text, in which a quote is written twice.
  bool quoted(WktNode& node) {
    std::string value;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] != '"') {
        value += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        value += text_[at_++];
      } else {
        ++at_;
        node.values.push_back(value);
        return true;
      }
    }
    return false;
  }
  // Reads a keyword, a number or a bare word such as NORTH.
  std::string word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
                                  std::string_view("_.+-").find(text_[at_]) != text_.npos))
      ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  bool take(std::string_view any_of) {
    skip_blanks();
    if (at_ == text_.size() || any_of.find(text_[at_]) == any_of.npos) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

const WktNode* WktNode::find(std::initializer_list<std::string_view> keywords) const {
  if (contains(keywords, keyword)) return this;
  for (const WktNode& child : children)
    if (const WktNode* found = child.find(keywords)) return found;
  return nullptr;
}

std::optional<WktNode> parse_wkt(std::string_view text) { return Parser(text).node(); }

}  // namespace plotscan::scan
