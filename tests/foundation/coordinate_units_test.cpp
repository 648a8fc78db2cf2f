// SPDX-License-Identifier: Apache-2.0
#include "core/coordinate_units.h"

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(CoordinateUnits, EverySymbolHasALengthAndAName) {
  // NIST Special Publication 811, appendix B.6: 1 ft = 0.3048 m, 1 US survey foot = 1200/3937 m.
  EXPECT_EQ(unit_named("m"), 1);
  EXPECT_EQ(unit_named("cm"), 0.01);
  EXPECT_EQ(unit_named("mm"), 0.001);
  EXPECT_EQ(unit_named("ft"), 0.3048);
  EXPECT_EQ(unit_named("us-ft"), 1200.0 / 3937);
  EXPECT_EQ(unit_named("furlong"), std::nullopt);
  for (const std::string& symbol : unit_symbols())
    EXPECT_EQ(unit_name(unit_named(symbol).value()).find("units of"), std::string::npos) << symbol;
  EXPECT_EQ(unit_name(0.25), "units of 0.25 m");
}

TEST(CoordinateUnits, RoundedLengthsAreTakenForTheUnitTheyStandFor) {
  EXPECT_EQ(exact_unit(0.3048006), kUsSurveyFoot_m);
  EXPECT_EQ(exact_unit(0.30480001), kFoot_m);
  EXPECT_EQ(exact_unit(0.001), 0.001);
  EXPECT_EQ(exact_unit(0.9144), 0.9144);
}

}  // namespace
}  // namespace plotscan
