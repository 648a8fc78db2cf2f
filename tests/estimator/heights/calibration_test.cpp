// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include <cmath>

#include <gtest/gtest.h>

#include "heights/features.h"
#include "heights/ratio_model.h"

namespace plotscan::heights {
namespace {

TEST(Calibration, TheShippedOneFitsTheFeatures) {
  EXPECT_EQ(shipped_calibration().features, feature_names());
  EXPECT_EQ(shipped_calibration().heights.size(), 8);
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
  const std::vector<Prediction> predictions =
      Kriging(shipped.places(), shipped.ratios(), shipped.noise(), shipped.covariance)
          .without_own_group(libraries);
  for (std::size_t k = 0; k < shipped.heights.size(); ++k) {
    const auto height = static_cast<Eigen::Index>(k);
    double inside = 0;
    double surprise = 0;
    for (std::size_t i = 0; i < predictions.size(); ++i) {
      const double error = shipped.farms[i].ratios(height) - predictions[i].values(height);
      const double sd = predictions[i].sds(height);
      inside += std::abs(error) < 1.96 * sd ? 1 : 0;
      surprise += std::pow(error / sd, 2);
    }
    const auto farms = static_cast<double>(predictions.size());
    EXPECT_GT(inside / farms, 0.88) << shipped.heights[k];
    EXPECT_LT(inside / farms, 0.99) << shipped.heights[k];
    EXPECT_NEAR(std::sqrt(surprise / farms), 1, 0.3) << shipped.heights[k];
  }
}

TEST(Calibration, FewFarmsAreUnlikeWhatIsKnown) {
  const Calibration& shipped = shipped_calibration();
  const RatioModel model(shipped);
  const Eigen::MatrixXd places = shipped.places();
  int unlike = 0;
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    unlike += model.unlike(places.row(i)) > 1 ? 1 : 0;
  EXPECT_LT(unlike, 0.03 * static_cast<double>(places.rows()));
  // A field of glass plates on stilts: all features as far from the middle as they can be, by
  // turns.
  Eigen::VectorXd far = Eigen::VectorXd::Constant(places.cols(), 4);
  for (Eigen::Index k = 0; k < far.size(); k += 2) far(k) = -4;
  EXPECT_GT(model.unlike(shipped.place(far)), 1);
}

}  // namespace
}  // namespace plotscan::heights
