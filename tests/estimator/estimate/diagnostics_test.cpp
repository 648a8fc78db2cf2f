// SPDX-License-Identifier: Apache-2.0
#include "estimate/diagnostics.h"

#include <gtest/gtest.h>

namespace plotscan::estimate {
namespace {

using nlohmann::json;

const PointAccount kAll{.read = 1127,
                        .in_area = 1000,
                        .unused = {{Unused::not_finite, 1},
                                   {Unused::marked, 2},
                                   {Unused::left_out, 4},
                                   {Unused::outside, 8},
                                   {Unused::repeated, 16},
                                   {Unused::thinned, 32},
                                   {Unused::outliers, 64},
                                   {Unused::without_ground, 100}},
                        .area_m = {1, 2, 3, 4}};

TEST(PointAccount, NamesWhatBecameOfEveryPoint) {
  EXPECT_EQ(
      text_of(kAll),
      "1127 read = 900 used + 1 without a place + 2 withheld or noise + 4 of classes left "
      "out + 8 outside the field + 16 repeated + 32 thinned + 64 neither ground nor crop + 100 "
      "where the ground is unknown");
}

TEST(PointAccount, NamesNothingThatDidNotHappen) {
  EXPECT_EQ(
      text_of({.read = 7, .in_area = 5, .unused = {{Unused::outside, 2}, {Unused::thinned, 0}}}),
      "7 read = 5 used + 2 outside the field");
}

// The keys of docs/estimate-format.md.
TEST(Diagnostics, AreWrittenByTheKeysOfTheFormat) {
  Diagnostics diagnostics{.notes = {{"a note"}},
                          .points = kAll,
                          .density_per_m2 = 12.5,
                          .ground = GroundFacts{0.2, 7, 0.5, 0.25, 0.01},
                          .crops = {{{"wheat", 0.75}}},
                          .why_no_plots = "a reason",
                          .boxes = GivenBoxes{3, "plot_id", true},
                          .names = GivenNames{2, "name", {PlotId("A"), PlotId(7)}}};
  diagnostics.of_method["voxels"] = 9;
  EXPECT_EQ(to_json(diagnostics), json::parse(R"({
    "notes": ["a note"], "points_read": 1127, "points_in_area": 1000, "not_finite": 1, "marked": 2,
    "left_out": 4, "outside": 8, "repeated": 16, "thinned": 32, "outliers": 64,
    "without_ground": 100, "area_m": [1.0, 2.0, 3.0, 4.0], "density_per_m2": 12.5,
    "ground": {"cell_m": 0.2, "nodes": 7, "seen_share": 0.5, "unknown_share": 0.25,
               "noise_m": 0.01},
    "crops": {"wheat": 0.75}, "why_no_plots": "a reason",
    "boxes": {"plots": 3, "id": "plot_id", "from_degrees": true},
    "names": {"plots": 2, "id": "name", "not_found": ["A", 7]}, "voxels": 9})"));
}

TEST(Diagnostics, SayNothingOfWhatIsNotKnown) { EXPECT_EQ(to_json({}), json::object()); }

}  // namespace
}  // namespace plotscan::estimate
