// SPDX-License-Identifier: Apache-2.0
#include "series/internal/dates.h"

#include <gtest/gtest.h>

#include "series/series.h"

namespace plotscan::series {
namespace {

TEST(Dates, AreFoundInNames) {
  EXPECT_EQ(date_in("2026-06-01"), "2026-06-01");
  EXPECT_EQ(date_in("wheat_2026_06_01_lattice"), "2026-06-01");
  EXPECT_EQ(date_in("20260601trial"), "2026-06-01");
  EXPECT_EQ(date_in("plot_20261301_20260730"), "2026-07-30");  // there is no 13th month
  for (const char* name : {"estimate", "2026-6-1", "120260601", "202606011", "2026-02-30"})
    EXPECT_EQ(date_in(name), name);
}

TEST(Dates, LieDaysApart) {
  EXPECT_EQ(days_between("2026-06-01", "2026-07-01"), 30);
  EXPECT_EQ(days_between("2024-02-28", "2024-03-01"), 2);
  EXPECT_EQ(days_between("2026-07-01", "2026-06-01"), -30);
  EXPECT_EQ(days_between("V6", "2026-06-01"), std::nullopt);
}

}  // namespace
}  // namespace plotscan::series
