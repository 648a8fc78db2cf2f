// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit_within.h"

#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>

namespace plotscan::calibration {
namespace {

// A plot's difference from its field's medians: its scaled features', and its ratios'.
struct Differences {
  Eigen::MatrixXd features;  // a row a plot
  Eigen::MatrixXd ratios;
};

Differences differences(const MeasuredField& field, const heights::CalibrationFarm& farm,
                        const heights::Calibration& calibration) {
  const auto plots = static_cast<Eigen::Index>(field.plots.size());
  Differences own{.features = Eigen::MatrixXd(plots, calibration.center.size()),
                  .ratios = Eigen::MatrixXd(plots, farm.ratios.size())};
  const Eigen::VectorXd middle = calibration.scaled(farm.features);
  for (Eigen::Index i = 0; i < plots; ++i) {
    const MeasuredPlot& plot = field.plots[static_cast<std::size_t>(i)];
    own.features.row(i) = calibration.scaled(plot.features) - middle;
    own.ratios.row(i) = ratios_of(plot, calibration.heights) - farm.ratios;
  }
  return own;
}

// Each height's spread that the weights of the differences leave, over a farm's plots.
Eigen::VectorXd spread_left(const Differences& own, const Eigen::MatrixXd& within) {
  const Eigen::MatrixXd left = own.ratios - own.features * within.transpose();
  return left.cwiseAbs2().colwise().mean().cwiseSqrt();
}

}  // namespace

void fit_within(std::span<const MeasuredField> fields, heights::Calibration& calibration) {
  constexpr double kRidge = 0.003;        // features scaled to 1
  constexpr double kLeastSpread = 0.005;  // of the ratio, what even the best farm leaves
  constexpr int kRounds = 4;
  std::vector<Differences> farms;
  for (std::size_t f = 0; f < fields.size(); ++f)
    farms.push_back(differences(fields[f], calibration.farms[f], calibration));
  const Eigen::Index count = calibration.center.size();
  const Eigen::Index heights = farms.front().ratios.cols();
  calibration.within = Eigen::MatrixXd::Zero(heights, count);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, heights);
    double plots = 0;
    for (std::size_t f = 0; f < farms.size(); ++f) {
      const Eigen::VectorXd& left = calibration.farms[f].within;
      const double weight = round == 0
                                ? 1
                                : 1 / (left.squaredNorm() / static_cast<double>(left.size()) +
                                       kLeastSpread * kLeastSpread);
      normal += weight * farms[f].features.transpose() * farms[f].features;
      right += weight * farms[f].features.transpose() * farms[f].ratios;
      plots += weight * static_cast<double>(farms[f].features.rows());
    }
    normal.diagonal().array() += kRidge * plots;
    calibration.within = normal.ldlt().solve(right).transpose();
    for (std::size_t f = 0; f < farms.size(); ++f)
      calibration.farms[f].within = spread_left(farms[f], calibration.within);
  }
}

Eigen::VectorXd spread_within(const MeasuredField& field, const heights::CalibrationFarm& farm,
                              const heights::Calibration& calibration) {
  return spread_left(differences(field, farm, calibration), calibration.within);
}

}  // namespace plotscan::calibration
