// SPDX-License-Identifier: Apache-2.0
#include "score/internal/matching.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "temporary_folder.h"

namespace plotscan::score {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PlotBox box_at(double x, double y = 0) {
  return {.center = {x, y}, .width_m = 1, .length_m = 1, .heading_rad = 0};
}

// Boxes crowded enough for several of them to overlap each other.
std::vector<PlotBox> random_boxes(RandomStream& random, std::size_t count) {
  std::vector<PlotBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    boxes.push_back({.center = {random.uniform(0, 2), random.uniform(0, 2)},
                     .width_m = random.uniform(0.8, 1.5),
                     .length_m = random.uniform(0.8, 1.5),
                     .heading_rad = random.uniform(0, std::numbers::pi)});
  }
  return boxes;
}

// Every one-to-one pairing of boxes that overlap by min_iou, as its overlaps in descending order.
std::vector<std::vector<double>> all_pairings(const std::vector<PlotBox>& truths,
                                              const std::vector<PlotBox>& estimates,
                                              double min_iou) {
  std::vector<std::vector<double>> pairings;
  std::vector<double> overlaps;
  std::set<std::size_t> taken;
  const std::function<void(std::size_t)> pair_from = [&](std::size_t truth) {
    if (truth == truths.size()) {
      pairings.push_back(overlaps);
      std::ranges::sort(pairings.back(), std::greater());
      return;
    }
    pair_from(truth + 1);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      const double iou = intersection_over_union(truths[truth], estimates[i]);
      if (iou < min_iou || !taken.insert(i).second) continue;
      overlaps.push_back(iou);
      pair_from(truth + 1);
      overlaps.pop_back();
      taken.erase(i);
    }
  };
  pair_from(0);
  return pairings;
}

std::vector<double> overlaps_of(const Matching& matching) {
  std::vector<double> overlaps;
  for (const PlotMatch& match : matching.matches) overlaps.push_back(match.iou);
  std::ranges::sort(overlaps, std::greater());
  return overlaps;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(MatchPlots, PairsAsTheBestOfAllPairings) {
  std::size_t contested = 0;
  for (std::uint64_t field = 0; field < 300; ++field) {
    RandomStream random(7, random_purpose("test/matching"), field);
    const auto truths = random_boxes(random, 1 + random.below(5));
    const auto estimates = random_boxes(random, 1 + random.below(5));
    const Matching matching = match_plots(truths, estimates, 0.3);
    const auto pairings = all_pairings(truths, estimates, 0.3);
    contested += pairings.size() > 2 ? 1 : 0;
    // The best pairing has the greatest first overlap, then the greatest second one, and so on.
    EXPECT_EQ(overlaps_of(matching), *std::ranges::max_element(pairings)) << "field " << field;
  }
  EXPECT_GT(contested, 50U);
}

TEST(MatchPlots, OverlapsMostInTotalWhereTrueBoxesAreApart) {
  for (std::uint64_t field = 0; field < 200; ++field) {
    RandomStream random(8, random_purpose("test/matching"), field);
    std::vector<PlotBox> truths, estimates;
    for (int i = 0; i < 5; ++i) {
      truths.push_back(box_at(1.05 * i));
      estimates.push_back(box_at(1.05 * i + random.uniform(-0.6, 0.6), random.uniform(-0.2, 0.2)));
    }
    double best = 0;
    for (const auto& pairing : all_pairings(truths, estimates, 0.501))
      best = std::max(best, sum(pairing));
    EXPECT_NEAR(sum(overlaps_of(match_plots(truths, estimates, 0.501))), best, 1e-12);
  }
}

TEST(MatchPlots, EveryPlotIsMatchedMissedOrExtraOnce) {
  for (std::uint64_t field = 0; field < 100; ++field) {
    RandomStream random(9, random_purpose("test/matching"), field);
    const auto truths = random_boxes(random, random.below(6));
    const auto estimates = random_boxes(random, random.below(6));
    const Matching matching = match_plots(truths, estimates, 0.4);
    std::multiset<std::size_t> seen_truths(matching.missed.begin(), matching.missed.end());
    std::multiset<std::size_t> seen_estimates(matching.extra.begin(), matching.extra.end());
    for (const PlotMatch& match : matching.matches) {
      seen_truths.insert(match.truth);
      seen_estimates.insert(match.estimate);
      EXPECT_GE(match.iou, 0.4);
      EXPECT_DOUBLE_EQ(match.iou,
                       intersection_over_union(truths[match.truth], estimates[match.estimate]));
    }
    EXPECT_EQ(seen_truths.size(), truths.size());
    EXPECT_EQ(std::set(seen_truths.begin(), seen_truths.end()).size(), truths.size());
    EXPECT_EQ(std::set(seen_estimates.begin(), seen_estimates.end()).size(), estimates.size());
  }
}

TEST(MatchPlots, CountsTheMissedAndTheExtra) {
  const Matching matching =
      match_plots({box_at(0), box_at(3), box_at(6)}, {box_at(6.1), box_at(9), box_at(0)}, 0.5);
  ASSERT_EQ(matching.matches.size(), 2U);
  EXPECT_EQ(matching.matches[0].estimate, 2U);
  EXPECT_EQ(matching.matches[1].truth, 2U);
  EXPECT_NEAR(matching.matches[1].iou, 0.9 / 1.1, 1e-12);
  EXPECT_THAT(matching.missed, ElementsAre(1U));
  EXPECT_THAT(matching.extra, ElementsAre(1U));
}

TEST(MatchPlots, TheLeastOverlapDecidesWhatCountsAsFound) {
  // Unit squares shifted by 0.2: the overlap is 0.8 / 1.2.
  EXPECT_THAT(match_plots({box_at(0)}, {box_at(0.2)}, 0.66).missed, IsEmpty());
  EXPECT_THAT(match_plots({box_at(0)}, {box_at(0.2)}, 0.67).missed, ElementsAre(0U));
}

TEST(MatchPlots, RefusesAnImpossibleOverlap) {
  for (const double min_iou : {0.0, -1.0, 1.5}) {
    EXPECT_THAT(plotscan::testing::message_of<InputError>([&] { match_plots({}, {}, min_iou); }),
                HasSubstr("over 0 and at most 1"));
  }
}

}  // namespace
}  // namespace plotscan::score
