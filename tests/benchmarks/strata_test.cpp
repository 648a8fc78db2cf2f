// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "description/load_description.h"
#include "lidar/fly_settings.h"
#include "planting/generate.h"
#include "scan/cloud_reader.h"
#include "strata/empty_field.h"
#include "strata/field_plan.h"
#include "strata/kept_field.h"
#include "strata/measured_field.h"
#include "strata/measurement_table.h"
#include "strata/scenery.h"
#include "strata/stratum_tally.h"
#include "strata/thinned_cloud.h"
#include "temporary_folder.h"

namespace plotscan::strata {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::filesystem::path kSource = PLOTSCAN_SOURCE_DIR;
const Sources kSources = {
    .strata = kSource / "benchmarks/strata",
    .worlds = kSource / "worlds",
    .meshes = std::filesystem::path(PLOTSCAN_SHARED_DATA_DIR) / "plants/cropcraft"};

class EveryStratum : public ::testing::TestWithParam<std::string> {};

// The word, the stratum and the index, and nothing else, make the field.
TEST_P(EveryStratum, IsDrawnFromTheWord) {
  const nlohmann::json plan = to_json(plan_field("word", GetParam(), 1, kSources));
  EXPECT_EQ(to_json(plan_field("word", GetParam(), 1, kSources)), plan);
  EXPECT_NE(to_json(plan_field("other", GetParam(), 1, kSources))["seed"], plan["seed"]);
  EXPECT_NE(to_json(plan_field("word", GetParam(), 2, kSources))["seed"], plan["seed"]);
}

// The descriptions hold, and the farms are of the size that the table promises.
TEST_P(EveryStratum, HasFarmsThatCanBeMade) {
  if (GetParam() == "others" && !std::filesystem::exists(kSources.meshes))
    GTEST_SKIP() << kSources.meshes << " is absent";
  for (int index = 0; index < 20; ++index) {
    const FieldPlan plan = plan_field("test", GetParam(), index, kSources);
    const planting::FarmDescription description =
        description::load_description(plan.farm, plan.overrides);
    EXPECT_NO_THROW(lidar::require_valid(plan.flight)) << index;
    std::size_t places = 0;
    for (const planting::TrialDescription& trial : description.trials)
      places += planting::plots_of(trial.plots);
    EXPECT_EQ(description.trials.size() > 1, GetParam() == "several") << index;
    EXPECT_GE(places, 12U) << index;
    EXPECT_LE(places, GetParam() == "kentland" ? 112U : 45U * description.trials.size()) << index;
  }
  const FieldPlan plan = plan_field("test", GetParam(), 0, kSources);
  const farm::Farm farm =
      planting::generate(description::load_description(plan.farm, plan.overrides), plan.seed);
  EXPECT_FALSE(farm.plots.empty() || farm.plants.empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryStratum, ::testing::ValuesIn(farm_strata()),
                         [](const auto& stratum) { return stratum.param; });

planting::PlotGridDescription grid_of(const std::string& stratum, int index) {
  const FieldPlan plan = plan_field("test", stratum, index, kSources);
  return description::load_description(plan.farm, plan.overrides).trials.front().plots;
}

TEST(PlanField, StrataAreWhatTheirNamesSay) {
  for (int index = 0; index < 20; ++index) {
    const planting::PlotGridDescription passes = grid_of("passes", index);
    EXPECT_LE(passes.gap_width_m, 0.4);
    EXPECT_FALSE(passes.column_alleys_m.empty());
    for (const auto& [after, width_m] : passes.column_alleys_m) {
      EXPECT_EQ(after % 2, 0U);
      EXPECT_GE(width_m, 0.5);
    }
    const planting::PlotGridDescription touching = grid_of("touching", index);
    EXPECT_EQ(std::min(touching.gap_width_m, touching.gap_length_m), 0.2);
    const planting::PlotGridDescription maize = grid_of("maize", index);
    EXPECT_GE(std::min(maize.gap_width_m, maize.gap_length_m), 0.5);
    EXPECT_LE(std::max(maize.gap_width_m, maize.gap_length_m), 1.0);
    const FieldPlan drilled = plan_field("test", "drilled", index, kSources);
    const planting::FarmDescription sown =
        description::load_description(drilled.farm, drilled.overrides);
    const auto rows = sown.trials[0].plants->cultivars.front().drill_rows;
    EXPECT_GE(rows, 2U);
    EXPECT_LE(rows, 5U);
    EXPECT_LE(sown.trials[0].plots.width_m / rows, 0.76 + 1e-9);
    EXPECT_GE(sown.trials[0].plots.width_m / rows, 0.19 - 1e-9);
  }
}

class EveryEmptyKind : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryEmptyKind, IsDrawnFromTheWord) {
  const auto draw = [&](const std::string& word) {
    RandomStream random = field_stream(word, GetParam(), 0);
    return draw_empty_field(GetParam(), random);
  };
  const std::vector<Eigen::Vector3f> points = draw("word");
  EXPECT_EQ(draw("word"), points);
  EXPECT_NE(draw("other"), points);
  EXPECT_GT(points.size(), 10'000U);
  EXPECT_LT(points.size(), 1'000'000U);
  for (const Eigen::Vector3f& point : points) ASSERT_TRUE(point.allFinite());
}

INSTANTIATE_TEST_SUITE_P(All, EveryEmptyKind, ::testing::ValuesIn(empty_kinds()),
                         [](const auto& kind) { return kind.param; });

double highest(const Thing& thing, const Eigen::Vector2d& place) {
  RandomStream random(1, random_purpose("test/scenery"), 0);
  double highest_m = 0;
  for (int i = 0; i < 2000; ++i)
    highest_m = std::max(highest_m, return_height(thing, place, random));
  return highest_m;
}

// Heights at places where the shapes' formulas are plain; 0 beside them.
TEST(Scenery, ThingsHaveTheirHeights) {
  const double turned = std::numbers::pi / 3;
  const PlotBox outline{.center = {3, 2}, .width_m = 2, .length_m = 6, .heading_rad = turned};
  const auto thing = [&](Shape shape) {
    return Thing{.shape = shape, .outline = outline, .height_m = 4};
  };
  const Eigen::Vector2d eaves = outline.center + 0.999 * outline.width_axis();
  EXPECT_DOUBLE_EQ(highest(thing(Shape::block), eaves), 4);
  EXPECT_NEAR(highest(thing(Shape::roof), outline.center), 4, 1e-9);
  EXPECT_NEAR(highest(thing(Shape::roof), eaves), 4 * 2.0 / 3, 0.01);
  EXPECT_NEAR(highest(thing(Shape::crown), outline.center), 4, 0.01);
  EXPECT_EQ(highest(thing(Shape::crown), outline.corners()[0]), 0);  // out of the ellipse
  EXPECT_NEAR(highest(thing(Shape::hedge), outline.center), 4, 0.01);
  EXPECT_NEAR(highest(thing(Shape::mound), outline.center), 4, 0.8);
  EXPECT_LT(highest(thing(Shape::canopy), outline.center), 4.01);
  EXPECT_DOUBLE_EQ(highest(thing(Shape::car), outline.center), 4);
  EXPECT_DOUBLE_EQ(highest(thing(Shape::car), outline.center - 2.9 * outline.length_axis()), 2.4);
  for (const Shape shape : {Shape::crown, Shape::hedge, Shape::car, Shape::block, Shape::roof,
                            Shape::mound, Shape::canopy}) {
    EXPECT_EQ(highest(thing(shape), outline.center + 1.01 * outline.width_axis()), 0);
    EXPECT_EQ(highest(thing(shape), outline.center + 3.01 * outline.length_axis()), 0);
  }
}

TEST(Scenery, CoverIsTheShareOfShotsThatStop) {
  const Thing crown{.shape = Shape::crown,
                    .outline = {.center = {0, 0}, .width_m = 2, .length_m = 2, .heading_rad = 0},
                    .height_m = 3,
                    .cover = 0.7};
  RandomStream random(2, random_purpose("test/scenery"), 0);
  int stopped = 0;
  constexpr int kShots = 10'000;
  for (int i = 0; i < kShots; ++i) stopped += return_height(crown, {0.1, 0.2}, random) > 0;
  EXPECT_NEAR(static_cast<double>(stopped) / kShots, 0.7, 0.02);
}

TEST(WritePositions, ComesBack) {
  const TemporaryFolder folder;
  const std::vector<Eigen::Vector3f> points = {{1, 2, 3}, {-0.5F, 1e-3F, 80}};
  write_positions(folder.path() / "cloud.pcd", points);
  std::vector<Eigen::Vector3f> read;
  scan::read_positions(folder.path() / "cloud.pcd", [&](std::span<const Eigen::Vector3d> piece) {
    for (const Eigen::Vector3d& point : piece) read.push_back(point.cast<float>());
  });
  EXPECT_EQ(read, points);
}

// A field that is there is left as it is; one of another word is not taken for it.
TEST(KeepEmptyField, IsMadeOnce) {
  const TemporaryFolder folder;
  const KeptField field = keep_empty_field("word", "bare", 0, folder.path() / "bare-0");
  const auto made = std::filesystem::last_write_time(field.cloud);
  keep_empty_field("word", "bare", 0, folder.path() / "bare-0");
  EXPECT_EQ(std::filesystem::last_write_time(field.cloud), made);
  EXPECT_THAT(message_of<InputError>(
                  [&] { keep_empty_field("other", "bare", 0, folder.path() / "bare-0"); }),
              HasSubstr("holds a field of another word"));
}

TEST(PlanField, TellsTheWidthOfPlotsWithoutAGap) {
  for (int index = 0; index < 8; ++index) {
    for (const char* stratum : {"gapless", "nursery"}) {
      const FieldPlan plan = plan_field("test", stratum, index, kSources);
      EXPECT_THAT(plan.overrides, ::testing::Contains("plots.gap_width_m=0"));
      EXPECT_NE(plan.stated, Stated::nothing);
    }
  }
  EXPECT_EQ(plan_field("test", "ordinary", 0, kSources).stated, Stated::nothing);
}

TEST(PlanField, APanelHasDwarfsAndGiants) {
  for (int index = 0; index < 8; ++index) {
    const FieldPlan plan = plan_field("test", "panel", index, kSources);
    const auto farm = description::load_description(plan.farm, plan.overrides);
    std::vector<double> sizes;
    for (const auto& cultivar : farm.trials[0].plants->cultivars)
      sizes.push_back(cultivar.min_scale + cultivar.max_scale);
    const auto [least, most] = std::ranges::minmax(sizes);
    EXPECT_GT(most, 2 * least);
  }
}

// Four plots in two rows: the cloud ends a margin from them on all sides.
TEST(KeepFarm, CutsTheCloudToTheMarginAboutThePlots) {
  const TemporaryFolder folder;
  FieldPlan plan = plan_field("test", "clipped", 0, kSources);
  ASSERT_GE(plan.margin_m.value(), 0);
  EXPECT_LE(*plan.margin_m, 2);
  plan.margin_m = 0.7;
  for (const char* override :
       {"plots.rows=[{plots: 2}, {plots: 2}]", "plots.missing_rate=0",
        "plots.alleys=[{after_row: 1, width_m: 1}]", "plots.width_m=2", "plots.length_m=3",
        "plots.gap_width_m=1", "plots.gap_length_m=1", "plots.heading_deg=30"})
    plan.overrides.emplace_back(override);
  plan.flight.speed_m_s = 6;
  const KeptField field = keep_farm(plan, folder.path() / "clipped-0", 2);
  // The plots' length lies along y before they are turned.
  const PlotBox plots{.width_m = 5, .length_m = 7, .heading_rad = 120 * kDegrees};
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector3f& point : scan::read_positions(field.cloud))
    seen.extend(plots.box_from_world(point.head<2>().cast<double>()));
  EXPECT_NEAR(seen.max().x(), 3.5 + 0.7, 0.02);
  EXPECT_NEAR(seen.min().x(), -3.5 - 0.7, 0.02);
  EXPECT_NEAR(seen.max().y(), 2.5 + 0.7, 0.02);
  EXPECT_NEAR(seen.min().y(), -2.5 - 0.7, 0.02);
}

// A farm of one kind of plots: as many found as there are errors, in centimetres.
MeasuredField field(const std::vector<double>& errors_cm, const std::vector<double>& confidences,
                    const std::vector<double>& false_confidences) {
  MeasuredField field{.stratum = "s",
                      .score = {},
                      .true_confidences = confidences,
                      .false_confidences = false_confidences,
                      .points = 2'000'000,
                      .seconds = 3,
                      .failure = {}};
  double truth_m = 0.5;
  for (const double error_cm : errors_cm) {
    truth_m += 0.1;
    const double height_m = truth_m + error_cm / 100;
    score::PlotScore plot;
    plot.truth.heights_m["height_max_m"] = truth_m;
    plot.found = score::FoundPlot{.iou = 0.9, .heights_m = {{"max", height_m}}};
    plot.found->errors["max"] = {
        .standard_error_m = 0.02, .low95_m = height_m - 0.04, .high95_m = height_m + 0.04};
    field.score.plots.push_back(plot);
  }
  for (std::size_t i = 0; i < false_confidences.size(); ++i)
    field.score.extra.push_back(static_cast<std::uint32_t>(100 + i));
  return field;
}

TEST(Tally, PoolsTheFarmsOfAStratum) {
  std::vector<MeasuredField> fields = {field({1, 3}, {1, 1}, {}), field({-6, 6}, {1, 1}, {0.5})};
  fields[0].box_figures = fields[0].box_figures_inside = 8;
  fields[1].box_figures = 8;
  fields[1].box_figures_inside = 4;
  const StratumTally all = tally("s", fields);
  EXPECT_EQ(all.farms, 2U);
  EXPECT_EQ(all.boxes.found, 4U);
  EXPECT_DOUBLE_EQ(all.boxes.precision, 0.8);
  EXPECT_NEAR(all.heights.at("max").score.rmse_m, std::sqrt((1 + 9 + 36 + 36) * 1e-4 / 4), 1e-12);
  EXPECT_NEAR(all.heights.at("max").within.worst_bias_m, 0.02, 1e-12);
  EXPECT_EQ(all.worst_height, "max");
  EXPECT_DOUBLE_EQ(all.worst_unflagged_share, 0.5);
  EXPECT_DOUBLE_EQ(all.coverage95, 0.5);
  EXPECT_DOUBLE_EQ(all.box_coverage95, 0.75);
  EXPECT_DOUBLE_EQ(all.seconds_per_million_points, 1.5);
}

// The estimator is given what is stated of the plots, and what it finds is counted.
TEST(MeasureField, CountsWhatTheEstimatorFinds) {
  const TemporaryFolder folder;
  FieldPlan plan = plan_field("test", "paper", 0, kSources);
  for (const char* override : {"terrain.side_m=30", "plots.rows.0.plots=4", "plots.rows.1.plots=4",
                               "plots.rows.2.plots=4", "plants.count=40"})
    plan.overrides.emplace_back(override);
  const KeptField field = keep_farm(plan, folder.path() / "paper-0", 2);
  const MeasuredField measured = measure_field("paper", 3, field, {.threads = 2});
  EXPECT_EQ(measured.stratum, "paper");
  EXPECT_EQ(measured.index, 3);
  EXPECT_EQ(measured.failure, "");
  EXPECT_EQ(measured.points, scan::read_positions(field.cloud).size());
  ASSERT_EQ(measured.score.plots.size(), 12U);
  EXPECT_EQ(std::ranges::count_if(measured.score.plots,
                                  [](const auto& plot) { return plot.found.has_value(); }),
            12);
  EXPECT_EQ(measured.true_confidences.size(), 12U);
  EXPECT_TRUE(measured.false_confidences.empty());
  EXPECT_EQ(measured.box_figures, 48U);
  EXPECT_GE(measured.box_figures_inside, 36U);
  const MeasuredField stated =
      measure_field("paper", 3, field, {.stated = Stated::sides, .threads = 2});
  EXPECT_EQ(stated.true_confidences.size(), 12U);
  std::size_t told_figures = 0;
  for (const score::PlotScore& plot : stated.score.plots)
    told_figures += plot.found.has_value() ? 2 : 0;
  EXPECT_GE(stated.box_figures_inside, told_figures) << "sides that were stated are right";
}

TEST(MeasureField, SaysWhyThereIsNoEstimate) {
  const TemporaryFolder folder;
  folder.write("cloud.pcd", "no cloud");
  const MeasuredField measured =
      measure_field("bare", 0, {.cloud = folder.path() / "cloud.pcd", .farm = {}}, {});
  EXPECT_THAT(measured.failure, HasSubstr("cloud.pcd"));
  EXPECT_EQ(measured.points, 0U);
  EXPECT_TRUE(measured.score.extra.empty());
}

// 400 returns in each square metre of 20 x 20 m.
TEST(ThinnedCloud, HasTheDensityThatIsAskedFor) {
  const TemporaryFolder folder;
  RandomStream random(5, random_purpose("test/thinned"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 160'000; ++i)
    points.emplace_back(static_cast<float>(i % 20 + random.uniform()),
                        static_cast<float>(i / 20 % 20 + random.uniform()), 0.0F);
  const auto cloud = folder.path() / "cloud.pcd";
  write_positions(cloud, points);
  EXPECT_EQ(thinned_cloud(cloud, 500, 1), cloud) << "it has no more";
  const std::vector<Eigen::Vector3f> thinned = scan::read_positions(thinned_cloud(cloud, 100, 1));
  EXPECT_NEAR(static_cast<double>(thinned.size()), 40'000, 500);
  int in_middle = 0;
  for (const Eigen::Vector3f& point : thinned)
    in_middle += (point.head<2>().array() - 10).abs().maxCoeff() < 5 ? 1 : 0;
  EXPECT_NEAR(in_middle, 10'000, 400);
}

TEST(ConfidenceAuc, CountsEveryPairOfATrueAndAFalsePlot) {
  RandomStream random(5, random_purpose("test/auc"), 0);
  std::vector<double> truths, falses;
  for (int i = 0; i < 40; ++i) truths.push_back(std::round(10 * random.uniform(0.3, 1)) / 10);
  for (int i = 0; i < 25; ++i) falses.push_back(std::round(10 * random.uniform(0, 0.8)) / 10);
  double above = 0;
  for (const double truth : truths)
    for (const double wrong : falses) above += truth > wrong ? 1 : truth == wrong ? 0.5 : 0;
  const std::vector<MeasuredField> fields = {field({}, truths, {}), field({}, {}, falses)};
  EXPECT_NEAR(confidence_auc(fields), above / (40 * 25), 1e-12);
  EXPECT_TRUE(std::isnan(confidence_auc({fields.data(), 1})));
}

TEST(TableLines, ShowStrataAndInventedPlots) {
  Measurement measurement{.farms = {field({1, 3}, {1, 1}, {}), field({-2}, {1}, {})},
                          .empty_fields = {field({}, {}, {0.2, 0.3}), field({}, {}, {})}};
  for (MeasuredField& empty : measurement.empty_fields) empty.stratum = "orchard";
  const std::vector<std::string> lines = table_lines(measurement);
  EXPECT_THAT(lines, ::testing::Contains(::testing::MatchesRegex("s +2 +3 1\\.0000 1\\.0000 .*")));
  EXPECT_THAT(lines, ::testing::Contains(::testing::MatchesRegex("orchard +2 +2 +1 .*")));
  EXPECT_THAT(lines.back(), HasSubstr("1.000"));
  const nlohmann::json document = to_json(measurement);
  EXPECT_EQ(document["strata"].size(), 1U);
  EXPECT_EQ(document["fields_without_plots"][0]["boxes"]["extra"], 2);
}

}  // namespace
}  // namespace plotscan::strata
