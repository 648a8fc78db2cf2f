// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/overlaps.h"

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "core/extent.h"
#include "core/list_of.h"
#include "core/text.h"

namespace plotscan::estimate {
namespace {

constexpr std::size_t kMostCovered = 10000;  // more need not be counted
constexpr std::size_t kMostNamed = 5;

bool overlap_by_half(const PlotBox& a, const PlotBox& b) {
  return 2 * intersection_area(a, b) > std::min(a.area_m2(), b.area_m2());
}

// The plots that lie over others, and how many these are; of two alike the first.
std::map<std::size_t, std::size_t> covering(const std::vector<PlotBox>& boxes) {
  const auto extents = list_of(boxes, [](const PlotBox& box) { return extent_of(box); });
  std::map<std::size_t, std::size_t> covered;
  std::size_t all = 0;
  for_each_meeting(extents, [&](std::size_t one, std::size_t other) {
    if (!overlap_by_half(boxes[one], boxes[other])) return true;
    ++covered[boxes[other].area_m2() > boxes[one].area_m2() ? other : one];
    return ++all < kMostCovered;
  });
  return covered;
}

}  // namespace

std::string overlap_note(const std::vector<PlotBox>& boxes, const std::vector<PlotId>& ids) {
  const std::map<std::size_t, std::size_t> covered = covering(boxes);
  if (covered.empty()) return "";
  std::vector<std::string> names;
  for (const auto& [plot, others] : covered) {
    if (names.size() == kMostNamed) {
      names.emplace_back("...");
      break;
    }
    names.push_back(
        fmt::format("plot {} over {} other{}", ids[plot].text(), others, others == 1 ? "" : "s"));
  }
  return "boxes of the map lie over each other by more than half: " + joined(names, ", ") +
         "; is a border drawn around plots, or one there twice?";
}

}  // namespace plotscan::estimate
