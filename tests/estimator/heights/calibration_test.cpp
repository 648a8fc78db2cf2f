// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include <cmath>

#include <gtest/gtest.h>

#include "heights/features.h"

namespace plotscan::heights {
namespace {

TEST(Calibration, TheShippedOneFitsTheFeatures) {
  EXPECT_EQ(shipped_calibration().features, feature_names());
  EXPECT_EQ(shipped_calibration().models.size(), 8);
}

TEST(Calibration, ReadsBackAsItWasWritten) {
  const Calibration& shipped = shipped_calibration();
  const Calibration read = calibration_of(json_of(shipped));
  EXPECT_EQ(json_of(read), json_of(shipped));
}

// Plants of libraries that were left out: their farms' truths lie in the 95 % intervals.
TEST(Calibration, IntervalsHoldForPlantsThatWereLeftOut) {
  const Calibration& shipped = shipped_calibration();
  std::map<std::string, int> numbers;
  std::vector<int> libraries;
  for (const CalibrationFarm& farm : shipped.farms)
    libraries.push_back(
        numbers.try_emplace(farm.library, static_cast<int>(numbers.size())).first->second);
  for (const auto& [height, model] : shipped.models) {
    const Eigen::VectorXd ratios = shipped.ratios_of(height);
    const std::vector<Prediction> predictions =
        Kriging(shipped.scaled_farms(), ratios, shipped.noise_of(height), model.covariance)
            .without_own_group(libraries);
    double inside = 0;
    double surprise = 0;
    for (std::size_t i = 0; i < predictions.size(); ++i) {
      const double error = ratios(static_cast<Eigen::Index>(i)) - predictions[i].value;
      inside += std::abs(error) < 1.96 * predictions[i].sd ? 1 : 0;
      surprise += std::pow(error / predictions[i].sd, 2);
    }
    const auto farms = static_cast<double>(predictions.size());
    EXPECT_GT(inside / farms, 0.88) << height;
    EXPECT_LT(inside / farms, 0.99) << height;
    EXPECT_NEAR(std::sqrt(surprise / farms), 1, 0.3) << height;
  }
}

}  // namespace
}  // namespace plotscan::heights
