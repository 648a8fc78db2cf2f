// SPDX-License-Identifier: Apache-2.0
#include "series/internal/join.h"

#include <algorithm>
#include <map>

namespace plotscan::series {
namespace {

struct Near {
  double apart_m;
  std::size_t known;
  std::size_t plot;
};

std::vector<Near> near_pairs(const std::vector<PlotSeries>& known,
                             const std::vector<estimate::PlotEstimate>& plots) {
  std::vector<Near> pairs;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const PlotBox& box = known[i].plot.box;
    for (std::size_t j = 0; j < plots.size(); ++j) {
      const Eigen::Vector2d& center = plots[j].box.center;
      if (box.contains(center)) pairs.push_back({(center - box.center).norm(), i, j});
    }
  }
  return pairs;
}

}  // namespace

Matches matches_by_id(const std::vector<PlotSeries>& known,
                      const std::vector<estimate::PlotEstimate>& plots) {
  std::map<PlotId, std::size_t> places;
  for (std::size_t i = 0; i < known.size(); ++i) places.emplace(known[i].plot.id, i);
  Matches matches;
  for (const estimate::PlotEstimate& plot : plots) {
    const auto found = places.find(plot.id);
    matches.push_back(found == places.end() ? std::nullopt : std::optional(found->second));
  }
  return matches;
}

Matches matches_by_place(const std::vector<PlotSeries>& known,
                         const std::vector<estimate::PlotEstimate>& plots) {
  std::vector<Near> pairs = near_pairs(known, plots);
  std::ranges::stable_sort(pairs, {}, &Near::apart_m);
  Matches matches(plots.size());
  std::vector<bool> taken(known.size());
  for (const Near& pair : pairs) {
    if (taken[pair.known] || matches[pair.plot]) continue;
    taken[pair.known] = true;
    matches[pair.plot] = pair.known;
  }
  return matches;
}

}  // namespace plotscan::series
