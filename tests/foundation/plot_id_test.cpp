// SPDX-License-Identifier: Apache-2.0
#include "core/plot_id.h"

#include <limits>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

using nlohmann::json;

TEST(PlotId, StaysWhatItIsGivenAs) {
  for (const char* value :
       {"101", "-7", "18446744073709551615", "\"A-12\"", "\"0101\"", "\"101\"", "1.5"}) {
    const auto id = PlotId::from(json::parse(value));
    ASSERT_TRUE(id) << value;
    EXPECT_EQ(json(*id).dump(), value);
  }
  EXPECT_EQ(json(PlotId(42)).dump(), "42");
}

TEST(PlotId, IsTheSameWhereItReadsAlike) {
  EXPECT_EQ(PlotId(101), PlotId("101"));
  EXPECT_EQ(PlotId::from(101.0), PlotId(101));
  EXPECT_NE(PlotId("0101"), PlotId(101));
}

TEST(PlotId, IsNoOtherValue) {
  for (const json& value : {json(nullptr), json(true), json(""), json(" \t"), json::array({1}),
                            json(std::numeric_limits<double>::infinity())}) {
    EXPECT_FALSE(PlotId::from(value)) << value;
  }
}

}  // namespace
}  // namespace plotscan
