// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/plot_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "core/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kFull = 0.4, kOpen = 0.2;  // canopy of a gap over that of the bands beside it
constexpr double kOneWidth = 1.3;           // gaps up to so much wider than others are as wide
constexpr double kLeastClear = 0.85;        // of the gaps, that are full or open
constexpr double kLeastWhole = 0.66;        // of the plots, that have the usual number of parts

struct Gap {
  double width = 0, level = 0;  // level: over that of the bands beside it
  bool is_full() const { return level > kFull; }
  bool is_clear() const { return level > kFull || level < kOpen; }
};

using Gaps = std::vector<std::vector<Gap>>;  // line by line

Gaps gaps_of(std::span<const ProfileSums> profiles, const std::vector<std::vector<int>>& begins,
             int size) {
  Gaps gaps;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const ProfileSums& profile = profiles[i];
    gaps.emplace_back();
    for (std::size_t k = 1; k < begins[i].size(); ++k) {
      const int before = begins[i][k - 1], after = begins[i][k];
      const double bands =
          0.5 * (profile.mean(before, before + size) + profile.mean(after, after + size));
      gaps.back().push_back({.width = 1.0 * (after - before - size),
                             .level = profile.mean(before + size, after) / std::max(1e-9, bands)});
    }
  }
  return gaps;
}

// Whether gaps as wide as each other are some full and some open.
bool differ(const Gaps& gaps) {
  std::vector<double> widths;
  for (const auto& line : gaps)
    for (const Gap& gap : line) widths.push_back(gap.width);
  if (widths.empty()) return false;
  const double usual = quantile(widths, 0.5);
  double clear = 0, full = 0, full_width = 0, open = 0, open_width = 0;
  for (const auto& line : gaps) {
    for (const Gap& gap : line) {
      if (gap.width > kOneWidth * usual) continue;
      clear += gap.is_clear();
      (gap.is_full() ? full : open) += 1;
      (gap.is_full() ? full_width : open_width) += gap.width;
    }
  }
  return full > 0 && open > 0 && clear >= kLeastClear * (full + open) &&
         open_width / open <= kOneWidth * full_width / full;
}

// A plot's first and last band.
struct Parts {
  int first = 0, last = 0;
  int count = 0;
};

std::vector<Parts> parts_on(const std::vector<int>& begins, const std::vector<Gap>& gaps) {
  std::vector<Parts> plots;
  for (std::size_t k = 0; k < begins.size(); ++k) {
    if (k == 0 || !gaps[k - 1].is_full()) plots.push_back({.first = begins[k]});
    plots.back().last = begins[k];
    ++plots.back().count;
  }
  return plots;
}

int usual_count(const std::vector<std::vector<Parts>>& lines) {
  std::map<int, int> times;
  for (const auto& line : lines)
    for (const Parts& plot : line) ++times[plot.count];
  return std::ranges::max_element(times, {}, [](const auto& entry) { return entry.second; })->first;
}

}  // namespace

std::optional<JoinedParts> joined_parts(std::span<const ProfileSums> profiles,
                                        const std::vector<std::vector<int>>& begins, int size) {
  const Gaps gaps = gaps_of(profiles, begins, size);
  if (!differ(gaps)) return std::nullopt;
  std::vector<std::vector<Parts>> lines;
  for (std::size_t i = 0; i < begins.size(); ++i) lines.push_back(parts_on(begins[i], gaps[i]));
  const int count = usual_count(lines);
  if (count < 2) return std::nullopt;
  JoinedParts joined;
  std::vector<double> sizes;
  double all = 0;
  for (const auto& line : lines) {
    joined.begins.emplace_back();
    for (const Parts& plot : line) {
      ++all;
      if (plot.count != count) continue;
      joined.begins.back().push_back(plot.first);
      sizes.push_back(plot.last + size - plot.first);
    }
  }
  if (static_cast<double>(sizes.size()) < kLeastWhole * all) return std::nullopt;
  joined.size = static_cast<int>(std::lround(quantile(std::move(sizes), 0.5)));
  return joined;
}

}  // namespace plotscan::plots
