// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/each_index.h"
#include "core/error.h"
#include "heights/crop_model.h"
#include "heights/features.h"
#include "heights/measure_heights.h"
#include "heights/ratio_model.h"

namespace plotscan::heights {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Calibration, TheShippedOneFitsTheFeatures) {
  EXPECT_EQ(shipped_calibration().features, feature_names());
  EXPECT_EQ(shipped_calibration().heights.size(), 8);
}

TEST(Calibration, NamesTheCropsOfTheShippedOne) {
  EXPECT_EQ(crop_names(), shipped_calibration().crops);
}

TEST(Calibration, ReadsBackAsItWasWritten) {
  const Calibration& shipped = shipped_calibration();
  const Calibration read = calibration_of(json_of(shipped));
  EXPECT_EQ(json_of(read), json_of(shipped));
}

std::vector<std::size_t> farms_of(const Calibration& calibration, const std::string& library) {
  std::vector<std::size_t> farms;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    if (calibration.farms[i].library == library) farms.push_back(i);
  return farms;
}

// Farms of whole libraries that the regression leaves out. What is fitted once to all farms, scales
// and weights, has seen them: blind is scripts/measure_plots, on plants of its own.
struct Unseen {
  std::size_t farms = 0, inside = 0, of_its_crop = 0;
  double told_squares = 0, given_squares = 0;  // of the mean's errors, square metres
};

Unseen of_unseen(const std::vector<std::string>& libraries) {
  const Calibration& shipped = shipped_calibration();
  const auto mean = std::ranges::find(shipped.heights, "mean") - shipped.heights.begin();
  Unseen unseen;
  for (const std::string& library : libraries) {
    const std::vector<std::size_t> farms = farms_of(shipped, library);
    const Calibration others = shipped.without(farms);
    const RatioModel model(others);
    const CropModel crops(others);
    for (const std::size_t i : farms) {
      const CalibrationFarm& farm = shipped.farms[i];
      const Eigen::VectorXd scaled = others.scaled(farm.features);
      const Eigen::VectorXd probabilities = crops.probabilities(scaled);
      const auto ratios = [&](const Eigen::VectorXd& crop, bool is_given) {
        return model.at(
            scaled, farm.top_m,
            {.probabilities = crop, .novelty = crops.novelty(scaled), .given = is_given});
      };
      const FieldRatios told = ratios(probabilities, false);
      const FieldRatios given = ratios(shipped.indicators_of(farm.crop), true);
      const double error = told.values(mean) - farm.ratios(mean);
      ++unseen.farms;
      unseen.inside += std::abs(error) < 2.064 * told.field_sds(mean) ? 1 : 0;
      unseen.of_its_crop +=
          probabilities(static_cast<Eigen::Index>(shipped.index_of(farm.crop))) > 0.5 ? 1 : 0;
      unseen.told_squares += std::pow(farm.top_m * error, 2);
      unseen.given_squares += std::pow(farm.top_m * (given.values(mean) - farm.ratios(mean)), 2);
    }
  }
  return unseen;
}

// Plants of libraries that were left out: their farms' truths lie in the 95 % intervals, and their
// crop is told from the canopy.
TEST(Calibration, HoldsForPlantsThatWereLeftOut) {
  const Unseen unseen = of_unseen({"soybean-r1", "soybean-r3", "soybean-bushy", "soybean-v6",
                                   "wheat-z55", "wheat-ripe", "wheat-single-z39", "maize-r3"});
  const auto farms = static_cast<double>(unseen.farms);
  EXPECT_GT(farms, 80);
  EXPECT_GT(static_cast<double>(unseen.inside), 0.86 * farms);
  EXPECT_LT(static_cast<double>(unseen.inside), 0.995 * farms);
  EXPECT_GT(static_cast<double>(unseen.of_its_crop), 0.85 * farms);
}

// Of farms whose whole library was left out: as many are of the crop that they are told to be as
// the probabilities say, and hardly any of those that are told with 95 % and more is of another.
TEST(Calibration, KnowsHowSurelyItTellsTheCrop) {
  const Calibration& shipped = shipped_calibration();
  std::set<std::string> libraries;
  for (const CalibrationFarm& farm : shipped.farms) libraries.insert(farm.library);
  double said = 0;
  std::size_t right = 0, sure = 0, surely_wrong = 0;
  for (const std::string& library : libraries) {
    const std::vector<std::size_t> farms = farms_of(shipped, library);
    const CropModel others(shipped.without(farms));
    for (const std::size_t i : farms) {
      Eigen::Index told = 0;
      const double probability =
          others.probabilities(shipped.scaled(shipped.farms[i].features)).maxCoeff(&told);
      const bool is_right = shipped.crops[static_cast<std::size_t>(told)] == shipped.farms[i].crop;
      said += probability;
      right += is_right ? 1 : 0;
      sure += probability > 0.95 ? 1 : 0;
      surely_wrong += probability > 0.95 && !is_right ? 1 : 0;
    }
  }
  const auto count = static_cast<double>(shipped.farms.size());
  EXPECT_NEAR(said / count, static_cast<double>(right) / count, 0.02);
  EXPECT_GT(static_cast<double>(sure), 0.6 * count);
  EXPECT_LT(static_cast<double>(surely_wrong), 0.02 * static_cast<double>(sure));
}

// Where a crop is left out with all of its farms, the others' intervals hold most of its heights
// all the same: they are as wide as what so little is known of asks for.
TEST(Calibration, KnowsHowLittleItKnowsOfACropThatWasLeftOut) {
  const Calibration& shipped = shipped_calibration();
  for (const std::string& crop : shipped.crops) {
    std::vector<std::size_t> farms;
    for (std::size_t i = 0; i < shipped.farms.size(); ++i)
      if (shipped.farms[i].crop == crop) farms.push_back(i);
    const Calibration others = shipped.without(farms);
    const RatioModel model(others);
    const CropModel crops(others);
    double inside = 0;
    for (const std::size_t i : farms) {
      const CalibrationFarm& farm = shipped.farms[i];
      const Eigen::VectorXd scaled = others.scaled(farm.features);
      Eigen::VectorXd told = crops.probabilities(scaled);
      told(static_cast<Eigen::Index>(shipped.index_of(crop))) = 0;
      const FieldRatios ratios = model.at(
          scaled, farm.top_m,
          {.probabilities = told / told.sum(), .novelty = crops.novelty(scaled), .given = false});
      const Eigen::ArrayXd errors = (ratios.values - farm.ratios).cwiseQuotient(ratios.field_sds);
      inside += (errors.abs() < 2.064).cast<double>().mean();
    }
    EXPECT_GT(inside, 0.65 * static_cast<double>(farms.size())) << crop;
  }
}

std::vector<std::string> soybean_libraries() {
  std::set<std::string> names;
  for (const CalibrationFarm& farm : shipped_calibration().farms)
    if (farm.crop == "soybean") names.insert(farm.library);
  return {names.begin(), names.end()};
}

TEST(Calibration, IsSurerOfSoybeansMeanWhereTheCropIsGiven) {
  const Unseen unseen = of_unseen(soybean_libraries());
  EXPECT_LT(unseen.given_squares, 0.85 * unseen.told_squares);
}

TEST(Calibration, RefusesACropThatItDoesNotKnow) {
  EXPECT_THAT([] { shipped_calibration().index_of("barley"); },
              ThrowsMessage<InputError>(HasSubstr("there is maize, soybean, wheat")));
}

// By hand: two scores apart by ln 3 / sharpness are as 3 to 1.
TEST(Calibration, ScoresBecomeProbabilities) {
  const Eigen::Vector2d scores(std::log(3) / 5, 0);
  EXPECT_NEAR(softmax(scores, 5)(0), 0.75, 1e-12);
}

// Two crops that may be: the mixture's mean and variance, by its two parts.
TEST(Calibration, MixesTheCropsThatItMayBe) {
  const Calibration& shipped = shipped_calibration();
  const RatioModel model(shipped);
  const Eigen::VectorXd scaled = shipped.scaled(shipped.farms.front().features);
  const auto of = [&](const std::string& crop) {
    return model.mixture(scaled, 0.8, shipped.indicators_of(crop));
  };
  const Prediction maize = of("maize"), wheat = of("wheat");
  const Prediction both = model.mixture(
      scaled, 0.8, 0.25 * shipped.indicators_of("maize") + 0.75 * shipped.indicators_of("wheat"));
  const double value = 0.25 * maize.values(0) + 0.75 * wheat.values(0);
  const double apart = maize.values(0) - wheat.values(0);
  EXPECT_NEAR(both.values(0), value, 1e-12);
  EXPECT_NEAR(std::pow(both.sds(0), 2),
              0.25 * std::pow(maize.sds(0), 2) + 0.75 * std::pow(wheat.sds(0), 2) +
                  0.25 * 0.75 * apart * apart,
              1e-12);
}

// Farms of other crops say nothing of a crop's heights.
TEST(Calibration, ACropsHeightsFollowFromItsOwnFarms) {
  const Calibration& shipped = shipped_calibration();
  const Calibration maize = shipped.of_crop("maize");
  EXPECT_LT(maize.farms.size(), shipped.farms.size());
  const CalibrationFarm wheat = shipped.of_crop("wheat").farms.front();
  const Eigen::VectorXd scaled = shipped.scaled(wheat.features);
  const Eigen::VectorXd is_maize = shipped.indicators_of("maize");
  const Prediction by_all = RatioModel(shipped).mixture(scaled, wheat.top_m, is_maize);
  const Prediction by_maize = RatioModel(maize).mixture(scaled, wheat.top_m, is_maize);
  EXPECT_EQ(by_all.values, by_maize.values);
  EXPECT_EQ(by_all.sds, by_maize.sds);
}

// Regressions are factorised when first asked for, by whichever thread is first.
TEST(Calibration, ThreadsMayShareAModel) {
  const Calibration& shipped = shipped_calibration();
  const RatioModel shared(shipped);
  constexpr std::size_t kAsked = 60;
  const auto novelty_by = [&](const RatioModel& model, std::size_t i) {
    const CalibrationFarm& farm = shipped.farms[i * (shipped.farms.size() / kAsked)];
    return model.novelty(shipped.scaled(farm.features), shipped.indicators_of(farm.crop));
  };
  std::vector<double> by_many(kAsked);
  for_each_index(kAsked, 4, [&](std::size_t i) { by_many[i] = novelty_by(shared, i); });
  const RatioModel alone(shipped);
  for (std::size_t i = 0; i < kAsked; ++i) EXPECT_EQ(by_many[i], novelty_by(alone, i));
}

TEST(Calibration, FewFarmsAreUnlikeWhatIsKnown) {
  const Calibration& shipped = shipped_calibration();
  const RatioModel model(shipped);
  int novelty = 0;
  for (const CalibrationFarm& farm : shipped.farms)
    novelty += model.novelty(shipped.scaled(farm.features), shipped.indicators_of(farm.crop)) > 1;
  EXPECT_LT(novelty, 0.03 * static_cast<double>(shipped.farms.size()));
  // A field of glass plates on stilts: all features as far from the middle as they can be, by
  // turns.
  Eigen::VectorXd far = Eigen::VectorXd::Constant(shipped.center.size(), 4);
  for (Eigen::Index k = 0; k < far.size(); k += 2) far(k) = -4;
  EXPECT_GT(model.novelty(far, shipped.indicators_of("maize")), 1);
}

}  // namespace
}  // namespace plotscan::heights
