// SPDX-License-Identifier: Apache-2.0
#pragma once

// Well-known text of coordinate systems (OGC 01-009 and ISO 19162).

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plotscan::scan {

// One node: KEYWORD["text", 1.5, CHILD[...]].
struct WktNode {
  std::string keyword;
  std::vector<std::string> values = {};  // texts without their quotes, numbers, bare words
  std::vector<WktNode> children = {};

  // This node or the first one below it with one of the keywords; nullptr if there is none.
  const WktNode* find(std::initializer_list<std::string_view> keywords) const;
};

// Parses well-known text; absent if it is broken.
std::optional<WktNode> parse_wkt(std::string_view text);

}  // namespace plotscan::scan
