// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include "calibration/farm_groups.h"
#include "calibration/fit.h"
#include "calibration/leave_out.h"
#include "core/error.h"
#include "core/random.h"
#include "heights/features.h"
#include "heights/ratio_model.h"

namespace plotscan::calibration {
namespace {

constexpr double kSlope = 0.05;  // of the ratio, by the second feature

// The first feature tells the crops apart, the second one how tall plants are over the canopy's
// top; the others tell nothing, and a fifth of that is left to chance. Plots of a field differ by a
// tenth.
MeasuredField known_field(const std::string& library, int crop, std::uint64_t number) {
  RandomStream random(number, random_purpose("test/calibration_fit"), 0);
  const auto features = static_cast<Eigen::Index>(heights::feature_names().size());
  Eigen::VectorXd field(features);
  for (double& feature : field) feature = random.normal();
  field(0) = 4 * crop + 0.3 * random.normal();
  const double unknown = 0.01 * random.normal();
  MeasuredField known{.library = library, .plots = {}};
  for (int i = 0; i < 4; ++i) {
    MeasuredPlot plot{.top_m = 1, .features = field, .truth = {}};
    for (double& feature : plot.features) feature += 0.1 * random.normal();
    const double ratio = 0.8 + kSlope * plot.features(1) + unknown;
    plot.truth = {{"max", ratio + 0.1}, {"mean", ratio}};
    known.plots.push_back(plot);
  }
  return known;
}

std::vector<MeasuredField> known_fields() {
  std::vector<MeasuredField> fields;
  std::uint64_t number = 0;
  for (const std::string crop : {"maize", "soybean"}) {
    for (const std::string library : {"-a", "-b", "-c"}) {
      for (int farm = 0; farm < 20; ++farm)
        fields.push_back(known_field(crop + library, crop == "maize" ? 0 : 1, ++number));
    }
  }
  return fields;
}

TEST(CalibrationFit, FindsTheFeatureThatTellsTheHeights) {
  const heights::Calibration fitted = fit(known_fields());
  for (const heights::CalibrationFarm& farm : fitted.farms) {
    EXPECT_TRUE(farm.from_libraries.standardised.allFinite());
    EXPECT_TRUE(farm.from_crops.standardised.allFinite());
    EXPECT_EQ(farm.from_crops.standardised.size(), 2);
    EXPECT_GT(farm.from_crops.novelty, farm.from_libraries.novelty) << "no other crop is as like";
  }
  for (const Group group : {Group::farm, Group::library}) {
    for (const LeftOut& row : leave_out(fitted, group)) {
      EXPECT_LT(row.recognised.rmse_m, kSlope / 2) << row.name << " " << row.height;
      if (row.name == "all") {
        EXPECT_GT(row.recognised.inside, 0.9) << row.height;
      }
    }
  }
}

// Farms of three libraries of soybean; the calibration has two of them, and the third is added.
TEST(CalibrationFit, AnExtendedCalibrationKnowsItsNewFarms) {
  const std::vector<MeasuredField> fields = known_fields();
  const std::span<const MeasuredField> all = fields;
  const heights::Calibration before = fit(all.first(100));
  const heights::Calibration after = extended(before, all.subspan(100));
  ASSERT_EQ(after.farms.size(), fields.size());
  EXPECT_EQ(after.within, before.within);
  EXPECT_EQ(after.ratio_kernels.front().weights, before.ratio_kernels.front().weights)
      << "no farm of maize is new";
  EXPECT_NE(after.ratio_kernels.back().weights, before.ratio_kernels.back().weights);
  const std::vector<heights::Kernel> at_once = fit(all).ratio_kernels;
  EXPECT_NEAR(after.ratio_kernels.back().weights(1), at_once.back().weights(1), 0.05);
  for (std::size_t i = 100; i < fields.size(); ++i) {
    const heights::CalibrationFarm& farm = after.farms[i];
    EXPECT_LT(farm.within.maxCoeff(), 0.02) << "what is left to chance";
    EXPECT_TRUE(farm.from_libraries.standardised.allFinite());
    EXPECT_GT(farm.from_crops.novelty, farm.from_libraries.novelty);
    EXPECT_GT(farm.novelty, 0);
  }
  EXPECT_THROW(extended(before, {{{.library = "oat-a", .plots = fields.front().plots}}}),
               InputError);
}

TEST(CalibrationFit, NothingToPredictFromIsRefused) {
  const std::vector<MeasuredField> fields = known_fields();
  const std::span<const MeasuredField> all = fields;
  EXPECT_THROW(fit(all.first(80)), InputError) << "one library of soybean";
  EXPECT_THROW(fit(all.first(60)), InputError) << "maize alone";
}

// A farm is as new to a crop as its distance from the farms that it is compared with; more of these
// can only make it less so.
TEST(CalibrationFit, AddedFarmsAreComparedWithAllOtherLibraries) {
  std::vector<MeasuredField> fields = known_fields();
  for (int farm = 0; farm < 20; ++farm)
    fields.push_back(known_field("soybean-d", 1, fields.size() + 1));
  const std::span<const MeasuredField> all = fields;
  const heights::Calibration before = fit(all.first(100));  // soybean-c and soybean-d are left
  const auto novelty_of_first = [&](std::size_t added) {
    return extended(before, all.subspan(100, added)).farms[100].from_libraries.novelty;
  };
  const double alone = novelty_of_first(1);
  EXPECT_DOUBLE_EQ(novelty_of_first(20), alone) << "its own library is left out";
  EXPECT_LT(novelty_of_first(40), alone) << "another library was added with it";
}

// Maize's tallest plants, each farm predicted by all others with its crop given.
TEST(LeaveOut, SumsUpWhatTheOtherFarmsMissEachFarmBy) {
  heights::Calibration fitted = fit(known_fields());
  RandomStream random(1, random_purpose("test/leave_out"), 0);
  for (heights::CalibrationFarm& farm : fitted.farms) farm.top_m = random.uniform(0.5, 2);
  double squares = 0, sum = 0, inside = 0, farms = 0;
  for (std::size_t i = 0; i < fitted.farms.size(); ++i) {
    const heights::CalibrationFarm& farm = fitted.farms[i];
    if (farm.crop != "maize") continue;
    const heights::Calibration others = fitted.without({&i, 1});
    const Eigen::VectorXd scaled = others.scaled(farm.features);
    const heights::FieldRatios predicted =
        heights::RatioModel(others).at(scaled, farm.top_m,
                                       {.probabilities = others.indicators_of("maize"),
                                        .novelty = heights::CropModel(others).novelty(scaled),
                                        .given = true});
    const auto max = std::ranges::find(fitted.heights, "max") - fitted.heights.begin();
    const double error_m = farm.top_m * (predicted.values(max) - farm.ratios(max));
    squares += error_m * error_m;
    sum += error_m;
    inside += std::abs(error_m) < heights::kIntervalErrors * farm.top_m * predicted.field_sds(max);
    farms += 1;
  }
  const std::vector<LeftOut> rows = leave_out(fitted, Group::farm);
  const auto row = std::ranges::find_if(
      rows, [](const LeftOut& each) { return each.name == "maize" && each.height == "max"; });
  ASSERT_NE(row, rows.end());
  EXPECT_EQ(row->farms, 60U);
  EXPECT_NEAR(row->given.rmse_m, std::sqrt(squares / farms), 1e-12);
  EXPECT_NEAR(row->given.bias_m, sum / farms, 1e-12);
  EXPECT_NEAR(row->given.inside, inside / farms, 1e-12);
}

TEST(GroupsOf, EachFarmIsInOneGroup) {
  const heights::Calibration fitted = fit(known_fields());
  const auto name_of = [&](std::size_t farm, Group group) {
    if (group == Group::farm) return std::to_string(farm);
    return group == Group::crop ? fitted.farms[farm].crop : fitted.farms[farm].library;
  };
  for (const auto& [group, count] :
       {std::pair{Group::farm, 120U}, {Group::library, 6U}, {Group::crop, 2U}}) {
    const std::vector<std::vector<std::size_t>> groups = groups_of(fitted, group);
    EXPECT_EQ(groups.size(), count);
    std::set<std::size_t> seen;
    for (const std::vector<std::size_t>& farms : groups) {
      for (const std::size_t farm : farms) {
        EXPECT_TRUE(seen.insert(farm).second) << farm;
        EXPECT_EQ(name_of(farm, group), name_of(farms.front(), group));
      }
    }
    EXPECT_EQ(seen.size(), fitted.farms.size());
  }
}

TEST(KnownCrops, ACropThatWasLeftOutIsNotRecognised) {
  heights::Calibration others;
  others.crops = {"maize", "soybean", "wheat"};
  for (const char* crop : {"maize", "wheat"}) {
    heights::CalibrationFarm farm;
    farm.crop = crop;
    others.farms.push_back(farm);
  }
  const Eigen::VectorXd known = known_crops(others, Eigen::Vector3d(0.1, 0.6, 0.3));
  EXPECT_TRUE(known.isApprox(Eigen::Vector3d(0.25, 0, 0.75)));
}

}  // namespace
}  // namespace plotscan::calibration
