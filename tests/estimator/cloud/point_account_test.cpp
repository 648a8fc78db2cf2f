// SPDX-License-Identifier: Apache-2.0
#include "cloud/point_account.h"

#include <gtest/gtest.h>

namespace plotscan::cloud {
namespace {

TEST(PointAccount, NamesWhatBecameOfEveryPoint) {
  const nlohmann::json diagnostics = {
      {"points_read", 1127}, {"points_in_area", 1000}, {"not_finite", 1}, {"marked", 2},
      {"left_out", 4},       {"outside", 8},           {"repeated", 16},  {"thinned", 32},
      {"outliers", 64},      {"without_ground", 100}};
  EXPECT_EQ(
      point_account(diagnostics),
      "1127 read = 900 used + 1 without a finite place + 2 withheld or noise + 4 of classes left "
      "out + 8 outside the field + 16 repeated + 32 thinned + 64 neither ground nor crop + 100 "
      "where the ground is unknown");
}

TEST(PointAccount, NamesNothingThatDidNotHappen) {
  EXPECT_EQ(point_account({{"points_read", 7}, {"points_in_area", 5}, {"outside", 2}}),
            "7 read = 5 used + 2 outside the field");
}

}  // namespace
}  // namespace plotscan::cloud
