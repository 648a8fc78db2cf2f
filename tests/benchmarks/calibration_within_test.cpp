// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <span>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "calibration/fit_within.h"
#include "core/random.h"

namespace plotscan::calibration {
namespace {

constexpr int kFarms = 40;
constexpr Eigen::Index kFeatures = 3;

// Two heights' ratios follow three features of the plot by these weights, but for 1 %.
const Eigen::MatrixXd kWeights =
    (Eigen::MatrixXd(2, kFeatures) << 0.05, -0.03, 0, 0.02, 0, 0.04).finished();

MeasuredField even_field(std::uint64_t number, const Eigen::MatrixXd& weights) {
  RandomStream random(number, random_purpose("test/fit_within"), 0);
  MeasuredField field{.library = "wheat-a", .plots = {}};
  for (int i = 0; i < 8; ++i) {
    MeasuredPlot plot{.top_m = 0.8, .features = Eigen::VectorXd(kFeatures), .truth = {}};
    for (double& feature : plot.features) feature = random.normal();
    const Eigen::VectorXd ratios = weights * plot.features;
    plot.truth = {{"max", 0.8 * (1.1 + ratios(0) + 0.01 * random.normal())},
                  {"mean", 0.8 * (0.9 + ratios(1) + 0.01 * random.normal())}};
    field.plots.push_back(plot);
  }
  return field;
}

struct Fields {
  std::vector<MeasuredField> measured;
  heights::Calibration calibration;
};

void add(Fields& fields, MeasuredField field) {
  fields.calibration.farms.push_back({.library = field.library,
                                      .crop = "wheat",
                                      .features = Eigen::VectorXd::Zero(kFeatures),
                                      .ratios = Eigen::Vector2d(1.1, 0.9),
                                      .within = {},
                                      .from_libraries = {},
                                      .from_crops = {},
                                      .standardised_given_crop = {}});
  fields.measured.push_back(std::move(field));
}

Fields even_fields() {
  Fields fields{.measured = {},
                .calibration = {.heights = {"max", "mean"},
                                .center = Eigen::VectorXd::Zero(kFeatures),
                                .scale = Eigen::VectorXd::Ones(kFeatures),
                                .crop_kernel = {},
                                .within = {}}};
  for (std::uint64_t i = 0; i < kFarms; ++i) add(fields, even_field(i, kWeights));
  return fields;
}

TEST(FitWithin, FindsTheWeightsThatPlotsFollow) {
  Fields fields = even_fields();
  fit_within(fields.measured, fields.calibration);
  EXPECT_LT((fields.calibration.within - kWeights).cwiseAbs().maxCoeff(), 0.003);
  for (const heights::CalibrationFarm& farm : fields.calibration.farms)
    EXPECT_NEAR(farm.within.mean(), 0.01, 0.006) << "what does not follow them";
}

// Once more with the weights of the farms that are left: the ridge regression of all plots at once,
// a row a plot.
TEST(FitWithin, IsARidgeRegressionThatFarmsWeighInByWhatTheyLeave) {
  Fields fields = even_fields();
  add(fields, even_field(kFarms, -10 * kWeights));
  fit_within(fields.measured, fields.calibration);
  std::size_t plots = 0;
  for (const MeasuredField& field : fields.measured) plots += field.plots.size();
  Eigen::MatrixXd features(plots, kFeatures), ratios(plots, 2);
  Eigen::VectorXd weights(plots);
  Eigen::Index row = 0;
  for (std::size_t f = 0; f < fields.measured.size(); ++f) {
    const heights::CalibrationFarm& farm = fields.calibration.farms[f];
    for (const MeasuredPlot& plot : fields.measured[f].plots) {
      features.row(row) = plot.features;
      ratios.row(row) = ratios_of(plot, fields.calibration.heights) - farm.ratios;
      weights(row++) = 1 / (farm.within.cwiseAbs2().mean() + 0.005 * 0.005);
    }
  }
  Eigen::MatrixXd normal = features.transpose() * weights.asDiagonal() * features;
  normal += 0.003 * weights.sum() * Eigen::MatrixXd::Identity(kFeatures, kFeatures);
  const Eigen::MatrixXd expected =
      normal.inverse() * features.transpose() * weights.asDiagonal() * ratios;
  EXPECT_LT((fields.calibration.within - expected.transpose()).cwiseAbs().maxCoeff(), 1e-5);
}

// A lodged field, or one over a crease of the ground, goes its own way.
TEST(FitWithin, AFarmThatGoesItsOwnWayHardlyCounts) {
  Fields fields = even_fields();
  fit_within(fields.measured, fields.calibration);
  const Eigen::MatrixXd even = fields.calibration.within;
  add(fields, even_field(kFarms, -10 * kWeights));
  fit_within(fields.measured, fields.calibration);
  EXPECT_LT((fields.calibration.within - even).cwiseAbs().maxCoeff(), 0.001);
  EXPECT_GT(fields.calibration.farms.back().within(0), 0.2);
}

TEST(SpreadWithin, IsTheRootMeanSquareOfWhatTheWeightsLeave) {
  Fields fields = even_fields();
  fields.calibration.within = 0.5 * kWeights;
  const MeasuredField& field = fields.measured.front();
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (const MeasuredPlot& plot : field.plots) {
    for (int k = 0; k < 2; ++k) {
      double left = plot.truth.at(k == 0 ? "max" : "mean") / plot.top_m - (k == 0 ? 1.1 : 0.9);
      for (Eigen::Index i = 0; i < kFeatures; ++i) left -= 0.5 * kWeights(k, i) * plot.features(i);
      squares(k) += left * left / static_cast<double>(field.plots.size());
    }
  }
  const Eigen::VectorXd spread =
      spread_within(field, fields.calibration.farms.front(), fields.calibration);
  EXPECT_NEAR(spread(0), std::sqrt(squares(0)), 1e-12);
  EXPECT_NEAR(spread(1), std::sqrt(squares(1)), 1e-12);
}

}  // namespace
}  // namespace plotscan::calibration
