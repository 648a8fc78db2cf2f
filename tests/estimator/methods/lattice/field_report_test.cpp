// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/field_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plotscan::methods::lattice {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(FieldReport, TellsWhatWasLeftOut) {
  plots::PlotField field{.fit = plots::FieldFit{}};
  EXPECT_FALSE(json_of(field).contains("others_m2"));
  EXPECT_THAT(lines_of(field), Not(Contains(HasSubstr("left out"))));
  field.others_m2 = 477.6;
  EXPECT_EQ(json_of(field)["others_m2"], 477.6);
  EXPECT_THAT(lines_of(field), Contains(HasSubstr("left out   478 m2")));
  field.why_none = "no canopy";
  EXPECT_THAT(lines_of(field), Not(Contains(HasSubstr("left out"))));
}

}  // namespace
}  // namespace plotscan::methods::lattice
