// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/naming.h"

#include <gtest/gtest.h>

#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace {

TEST(Naming, PlotsAndPlantsAreReadBackFromTheNames) {
  EXPECT_EQ(plot_in_name(sdfxml::plot_element_name(12)), 12u);
  EXPECT_EQ(plot_in_name(weeds_name(sdfxml::plot_element_name(12))), 12u);
  EXPECT_EQ(plot_in_name(plant_model_name(12, 345)), 12u);
  EXPECT_EQ(plant_in_name(plant_model_name(12, 345)), 345u);
  EXPECT_EQ(plant_in_name(plant_model_name(0, 345)), 345u);
  EXPECT_EQ(plant_in_name(sdfxml::plant_element_name(4294967295u)), 4294967295u);
}

TEST(Naming, OtherNamesNameNothing) {
  for (const char* name :
       {"", "plot_", "plot_x", "plot_0", "plot_12a", "plot_-1", "plot_4294967296", "a_plot_12",
        "row_3", sdfxml::kTerrainModel, sdfxml::kPlantsOutsidePlots}) {
    EXPECT_FALSE(plot_in_name(name)) << name;
  }
  for (const std::string& name :
       {std::string("plant_"), std::string("plant_3_"), std::string("soyplant_3"),
        std::string("plant_0"), plant_model_name(3, 7) + "x", row_model_name(0, 3),
        row_model_name(2, 3), sdfxml::plot_element_name(12),
        std::string(sdfxml::kPlantsOutsidePlots), outside_model_name(3)}) {
    EXPECT_FALSE(plant_in_name(name)) << name;
  }
  EXPECT_FALSE(plot_in_name(plant_model_name(0, 345)));
  EXPECT_FALSE(plot_in_name(outside_model_name(3)));
}

}  // namespace
}  // namespace plotscan::gazebo
