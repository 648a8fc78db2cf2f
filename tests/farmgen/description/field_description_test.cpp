// SPDX-License-Identifier: Apache-2.0

#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/angle.h"
#include "core/error.h"
#include "description/load_description.h"

namespace plotscan::description {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// The example: two rows, of 3 and of 2 plots.
planting::FarmDescription loaded(const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  return load_description(write_example(folder), overrides);
}

TEST(FieldDescription, ReadsEveryKeyOfPlots) {
  const planting::PlotGridDescription grid =
      loaded({"plots.numbering=serpentine", "plots.first_number=101", "plots.skew_deg=-5",
              "plots.gap_width_m=1", "plots.missing=[105, 101]", "plots.missing_rate=0.25",
              "plots.alleys=[{after_column: 2, width_m: 2}, {after_row: 1, width_m: 3}]"})
          .trials[0]
          .plots;
  EXPECT_EQ(grid.numbering, PlotNumbering::serpentine);
  EXPECT_EQ(grid.first_number, 101u);
  EXPECT_DOUBLE_EQ(grid.skew_rad, -5 * kDegrees);
  EXPECT_EQ(grid.missing, (std::vector<std::uint32_t>{101, 105})) << "sorted";
  EXPECT_EQ(grid.missing_rate, 0.25);
  EXPECT_EQ(grid.column_alleys_m, (std::map<std::uint32_t, double>{{2, 2}}));
  EXPECT_EQ(grid.row_alleys_m, (std::map<std::uint32_t, double>{{1, 3}}));
}

TEST(FieldDescription, ReadsEveryKeyOfPlantsAndWeeds) {
  const planting::FarmDescription farm = loaded(
      {"plants.height_m={mean: 0.9, sd: 0.1}",
       "plants.lodging={plots_rate: 0.5, angle_deg: "
       "[10, 20]}",
       "plants.missing={rate: 0.1, gaps_per_plot: 2, gap_length_m: 0.5}", "plants.design=cycle",
       "plants.cultivars=[{name: A}, {name: B, count: 5, lodging: "
       "{plots_rate: 1, angle_deg: [30, 40], spread_deg: 3, direction_deg: 90}}]",
       "weeds={per_m2: 3, where: alleys, margin_m: 2, scale: [0.5, 1], models: [{crop: "
       "soybean}]}"});
  const std::vector<planting::CultivarDescription>& cultivars = farm.trials[0].plants->cultivars;
  ASSERT_EQ(cultivars.size(), 2u);
  EXPECT_EQ(farm.trials[0].plants->design.design, planting::TrialDesign::cycle);
  EXPECT_EQ(cultivars[0].name, "A");
  EXPECT_EQ(cultivars[0].count, 20u);
  EXPECT_EQ(cultivars[1].count, 5u);
  EXPECT_EQ(cultivars[1].height->mean_m, 0.9);
  EXPECT_EQ(cultivars[1].missing.gaps_per_plot, 2);
  EXPECT_DOUBLE_EQ(cultivars[0].lodging->spread_rad, 10 * kDegrees) << "the default";
  EXPECT_FALSE(cultivars[0].lodging->direction_rad);
  EXPECT_DOUBLE_EQ(*cultivars[1].lodging->direction_rad, 90 * kDegrees);
  EXPECT_EQ(cultivars[1].models, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(farm.weeds->per_m2, 3);
  EXPECT_EQ(farm.weeds->where, planting::WeedPlace::alleys);
  EXPECT_EQ(farm.weeds->margin_m, 2);
  EXPECT_EQ(farm.weeds->models, (std::vector<std::uint32_t>{2}));
}

TEST(FieldDescription, GrownModelsAreNamedByCropStageAndSeed) {
  const planting::FarmDescription farm = loaded(
      {"plants.models=[{crop: soybean, stage: R2, seed: 7, variants: 2}, {crop: soybean, name: "
       "mine, set: [nodes=9]}, {crop: soybean, name: bush, variants: 2, seed: 3}]"});
  ASSERT_EQ(farm.models.size(), 5u);
  EXPECT_EQ(farm.models[0].name, "soybean_R2_s7");
  EXPECT_EQ(farm.models[1].name, "soybean_R2_s8");
  EXPECT_EQ(farm.models[1].grown->seed, 8u);
  EXPECT_EQ(farm.models[2].name, "mine");
  EXPECT_EQ(farm.models[2].grown->assignments, (std::vector<std::string>{"nodes=9"}));
  EXPECT_EQ(farm.models[4].name, "bush_2");
  EXPECT_EQ(farm.models[4].grown->seed, 4u);
  EXPECT_EQ(planting::input_files(farm).size(), 1u) << "the description alone";
}

struct FieldMistake {
  const char* name;
  std::vector<std::string> overrides;
  const char* message;
};

// GoogleTest prints it beside the test's name.
void PrintTo(const FieldMistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakenField : public ::testing::TestWithParam<FieldMistake> {};

TEST_P(MistakenField, NamesKeyAndRange) {
  EXPECT_THAT(message_of<InputError>([] { loaded(GetParam().overrides); }),
              HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    FieldDescription, MistakenField,
    ::testing::Values(
        FieldMistake{"PitchAndGap",
                     {"plots.pitch={column_m: [2, 0], row_m: [0, 4]}"},
                     "plots.pitch takes the place of gap_width_m"},
        FieldMistake{"SkewedIntoEachOther",
                     {"plots.skew_deg=30", "plots.gap_width_m=0"},
                     "plots.skew_deg makes neighbours overlap: 1.299 m apart and 1.500 m wide"},
        FieldMistake{"AlleyBehindTheLast",
                     {"plots.alleys=[{after_row: 2, width_m: 1}]"},
                     "plots.alleys.0.after_row 2 is not in [1, 1]"},
        FieldMistake{"AlleyOfBoth",
                     {"plots.alleys=[{after_row: 1, after_column: 1, width_m: 1}]"},
                     "plots.alleys.0.after_row or after_column has to be given, one of the two"},
        FieldMistake{"AlleyTwice",
                     {"plots.alleys=[{after_row: 1, width_m: 1}, {after_row: 1, width_m: 2}]"},
                     "plots.alleys.1.after_row 1 has an alley already"},
        FieldMistake{
            "MissingPlotThatIsNot", {"plots.missing=[6]"}, "plots.missing.0 6 is not in [1, 5]"},
        FieldMistake{
            "MissingTwice", {"plots.missing=[3, 1, 3]"}, "plots.missing names plot 3 twice"},
        FieldMistake{
            "MissingAll", {"plots.missing=[1, 2, 3, 4, 5]"}, "plots.missing leaves no plot"},
        FieldMistake{"ShiftedRowsThatLeanOnEachOther",
                     {"plots.skew_deg=30", "plots.gap_length_m=0", "plots.rows.1.offset_m=0.5"},
                     "plots.skew_deg makes plots 1 and 4 overlap, which are in different rows"},
        FieldMistake{"CultivarThatIsNotListed",
                     {"plants.cultivars=[{name: A}, {name: B}]", "plants.design=list",
                      "plants.list=[A, A, A, A, A]"},
                     "plants.cultivars leave \"B\" without a plot"},
        FieldMistake{
            "MoreCultivarsThanPlots",
            {"plants.cultivars=[{name: A}, {name: B}, {name: C}, {name: D}, {name: E}, {name: "
             "F}]",
             "plants.design=random"},
            "plants.cultivars leave \"F\" without a plot"},
        FieldMistake{"VariantsPastTheLastSeed",
                     {"plants.models=[{crop: soybean, seed: 18446744073709551615, variants: 2}]"},
                     "plants.models.0.variants need seeds after the largest there is"},
        FieldMistake{"MoreModelsThanAFarmHolds",
                     {"plants.models=[{crop: soybean, variants: 1000}, {crop: maize}]"},
                     "plants.models make more than 1000 models in the whole farm"},
        FieldMistake{
            "NumberZero", {"plots.first_number=0"}, "plots.first_number 0 is not in [1, 1"},
        FieldMistake{"CountAndDensity",
                     {"plants.density_m2=3"},
                     "plants.density_m2 is given beside count; give one of the two"},
        FieldMistake{"HeightOfNothing",
                     {"plants.height_m={mean: 0.5, sd: 0.2}"},
                     "plants.height_m.sd is more than 0.3 of the mean"},
        FieldMistake{"GapLongerThanThePlot",
                     {"plants.missing={gaps_per_plot: 1, gap_length_m: 3.5}"},
                     "plants.missing.gap_length_m is longer than the plots"},
        FieldMistake{"GapWithoutLength",
                     {"plants.missing={gaps_per_plot: 1}"},
                     "plants.missing.gap_length_m has to be above 0 where there are gaps"},
        FieldMistake{"LodgingTurnedRound",
                     {"plants.lodging={plots_rate: 1, angle_deg: [70, 30]}"},
                     "plants.lodging.angle_deg is not [min, max]: min is the larger"},
        FieldMistake{"RateAboveOne",
                     {"plants.missing.rate=1.5"},
                     "plants.missing.rate 1.5 is not in [0, 1]"},
        FieldMistake{"UnknownKeyOfACultivar",
                     {"plants.cultivars=[{name: A, plots: 3}]"},
                     "plants.cultivars.0.plots is not a known key"},
        FieldMistake{"CultivarWithoutName",
                     {"plants.cultivars=[{count: 3}]"},
                     "plants.cultivars.0.name is missing"},
        FieldMistake{"CultivarTwice",
                     {"plants.cultivars=[{name: A}, {name: A}]"},
                     "plants.cultivars.1.name \"A\" is another cultivar's too"},
        FieldMistake{
            "NoWholeBlocks",
            {"plants.cultivars=[{name: A}, {name: B}]"},
            "plants.design makes no whole blocks: 5 plots are not a multiple of 2 cultivars"},
        FieldMistake{"WrongReplicates",
                     {"plants.cultivars=[{name: A}]", "plants.reps=4"},
                     "plants.reps 4 of 1 cultivars are 4 plots; the grid has 5"},
        FieldMistake{"ListOfUnknown",
                     {"plants.cultivars=[{name: A}]", "plants.design=list", "plants.list=[A, B]"},
                     "plants.list.1 \"B\" is not one of A"},
        FieldMistake{"ListWithoutDesign",
                     {"plants.cultivars=[{name: A}]", "plants.list=[A]"},
                     "plants.list and design: list belong together"},
        FieldMistake{"UnusedModels",
                     {"plants.cultivars=[{name: A, models: [{crop: soybean}]}]"},
                     "plants.models are not used: every cultivar has its own"},
        FieldMistake{"UnknownCrop",
                     {"plants.models=[{crop: tulip}]"},
                     "plants.models.0.crop \"tulip\" is not one of soybean"},
        FieldMistake{"UnknownStage",
                     {"plants.models=[{crop: soybean, stage: VT}]"},
                     "plants.models.0.stage \"VT\" is not one of "},
        FieldMistake{"MeshAndCrop",
                     {"plants.models=[{crop: soybean, mesh: a.obj}]"},
                     "plants.models.0.mesh is not a known key; known here are crop, stage"},
        FieldMistake{"OneNameForTwoModels",
                     {"plants.cultivars=[{name: A, models: [{crop: soybean, name: x}]}, {name: B, "
                      "models: [{crop: soybean, name: x, seed: 2}]}]"},
                     "names a model \"x\", and another list names another one so"},
        FieldMistake{"WeedsWithoutModels", {"weeds={per_m2: 1}"}, "weeds.models is missing"},
        FieldMistake{"WeedsSomewhere",
                     {"weeds={per_m2: 1, where: here, models: [{crop: soybean}]}"},
                     "weeds.where \"here\" is not one of everywhere, alleys, plots"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace plotscan::description
