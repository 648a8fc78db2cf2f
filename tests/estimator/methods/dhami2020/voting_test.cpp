// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/voting.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/plot_box.h"

namespace plotscan::methods::dhami2020 {
namespace {

TEST(Vote, TakesTheMeanOfTheFullestBin) {
  const Vote width = vote(std::vector{1.55, 1.65, 1.75, 0.9, 1.0, 3.2, 1.81}, 0.3);
  EXPECT_EQ(width.votes, 3u);  // [1.5, 1.8)
  EXPECT_NEAR(width.value, 1.65, 1e-12);
}

TEST(Vote, LetsTheLowestOfEqualBinsWin) {
  const Vote length = vote(std::vector{4.6, 3.1, 4.7, 3.2}, 0.5);
  EXPECT_EQ(length.votes, 2u);
  EXPECT_NEAR(length.value, 3.15, 1e-12);
}

TEST(Vote, HasNoVotesWithoutValues) {
  EXPECT_EQ(vote({}, 0.3).votes, 0u);
  EXPECT_EQ(vote_heading({}, 0.3).votes, 0u);
}

TEST(VoteHeading, GathersHeadingsOnBothSidesOfTheWrap) {
  const std::vector headings = {0.02, kPi - 0.04, 0.05, kPi - 0.03, 1.4, 1.5, 0.8};
  const Vote heading = vote_heading(headings, 0.3);
  EXPECT_EQ(heading.votes, 4u);
  EXPECT_LT(heading_difference(heading.value, 0), 1e-4);  // the plain mean is pi / 2
}

TEST(VoteHeading, TakesAHeadingAndItsOppositeForOne) {
  const Vote heading = vote_heading(std::vector{0.6 + kPi, 0.62, 0.58 - kPi, 2.0}, 0.3);
  EXPECT_EQ(heading.votes, 3u);
  EXPECT_NEAR(heading.value, 0.6, 1e-9);
}

TEST(VoteHeading, FindsEveryDirection) {
  for (double truth = 0; truth < kPi; truth += 0.01) {
    const std::vector headings = {truth - 0.01, truth, truth + 0.01, truth + 1.3};
    const Vote heading = vote_heading(headings, 0.3);
    EXPECT_GE(heading.votes, 2u) << truth;
    EXPECT_LT(heading_difference(heading.value, truth), 0.011) << truth;
  }
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
