// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "heights/features.h"
#include "heights/plot_ground.h"
#include <Eigen/Cholesky>

#include "core/statistics.h"

namespace plotscan::calibration {
namespace {

using heights::Covariance;

constexpr double kRidge = 0.05;       // of the within-field weights, features scaled to 1
constexpr double kLeastScale = 1e-6;  // of a feature that never varies
constexpr double kLeastTop_m = 0.05;

std::vector<int> library_groups(const heights::Calibration& calibration) {
  std::map<std::string, int> numbers;
  std::vector<int> groups;
  for (const heights::CalibrationFarm& farm : calibration.farms)
    groups.push_back(
        numbers.try_emplace(farm.library, static_cast<int>(numbers.size())).first->second);
  return groups;
}

// Mean negative log density of each farm's ratio, predicted without its group.
double surprise(const heights::Kriging& kriging, const Eigen::VectorXd& ratios,
                std::span<const int> groups) {
  const std::vector<heights::Prediction> predictions = kriging.without_own_group(groups);
  double sum = 0;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const double error = ratios(static_cast<Eigen::Index>(i)) - predictions[i].value;
    sum +=
        0.5 * error * error / (predictions[i].sd * predictions[i].sd) + std::log(predictions[i].sd);
  }
  return sum / static_cast<double>(predictions.size());
}

// Pattern search over the logarithms of the four numbers (Hooke and Jeeves 1961, its exploratory
// moves).
Covariance best_covariance(const Eigen::MatrixXd& places, const Eigen::VectorXd& ratios,
                           std::span<const int> groups) {
  const auto covariance_of = [](const std::array<double, 4>& logs) {
    return Covariance{.signal = std::exp(logs[0]),
                      .length = std::exp(logs[1]),
                      .linear = std::exp(logs[2]),
                      .noise = std::exp(logs[3])};
  };
  const auto cost = [&](const std::array<double, 4>& logs) {
    return surprise(heights::Kriging(places, ratios, covariance_of(logs)), ratios, groups);
  };
  std::array<double, 4> best = {std::log(0.08), std::log(1.0), std::log(0.03), std::log(0.02)};
  double least = cost(best);
  constexpr double kFirstStep = 0.6;
  constexpr double kLastStep = 0.1;
  for (double step = kFirstStep; step > kLastStep;) {
    bool better = false;
    for (std::size_t k = 0; k < best.size(); ++k) {
      for (const double change : {-step, step}) {
        std::array<double, 4> tried = best;
        tried[k] += change;
        const double found = cost(tried);
        if (!(found < least)) continue;
        least = found;
        best = tried;
        better = true;
      }
    }
    if (!better) step /= 2;
  }
  return covariance_of(best);
}

// The weights of the differences from the field's medians, by ridge regression.
void fit_within(std::span<const MeasuredField> fields, const heights::Calibration& calibration,
                const std::string& height, heights::HeightModel& model) {
  const Eigen::Index count = calibration.center.size();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  double squares = 0;
  double plots = 0;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const heights::CalibrationFarm& farm = calibration.farms[f];
    for (const MeasuredPlot& plot : fields[f].plots) {
      const Eigen::VectorXd own =
          calibration.scaled(plot.features) - calibration.scaled(farm.features);
      const double ratio = plot.truth.at(height) / plot.top_m - farm.ratios.at(height);
      normal += own * own.transpose();
      right += own * ratio;
      squares += ratio * ratio;
      plots += 1;
    }
  }
  const Eigen::MatrixXd ridged = normal + plots * kRidge * Eigen::MatrixXd::Identity(count, count);
  model.within = ridged.ldlt().solve(right);
  const double left =
      squares - 2 * model.within.dot(right) + model.within.dot(normal * model.within);
  model.within_sd = std::sqrt(std::max(0.0, left) / plots);
}

heights::CalibrationFarm farm_of(const MeasuredField& field) {
  std::vector<Eigen::VectorXd> features;
  for (const MeasuredPlot& plot : field.plots) features.push_back(plot.features);
  heights::CalibrationFarm farm{.library = field.library,
                                .features = heights::field_features(features)};
  for (const auto& [height, first] : field.plots.front().truth) {
    std::vector<double> ratios;
    for (const MeasuredPlot& plot : field.plots)
      ratios.push_back(plot.truth.at(height) / plot.top_m);
    farm.ratios[height] = quantile(ratios, 0.5);
  }
  return farm;
}

}  // namespace

MeasuredField measure(const FieldSample& sample) {
  constexpr double kMarginSigmas = 5;
  MeasuredField field{.library = sample.library, .plots = {}};
  const double noise_m = sample.surface.noise_m;
  for (const PlotSample& plot : sample.plots) {
    if (plot.points.empty()) continue;
    const heights::PlotGround ground = heights::ground_under(plot.box, sample.surface);
    const heights::HeightProfile profile = heights::without_noise(
        heights::height_profile(plot.box, plot.points, kMarginSigmas * noise_m), noise_m);
    heights::CanopyFeatures features =
        heights::canopy_features(plot.box, plot.points, profile, noise_m, ground.slope);
    if (features.top_m < kLeastTop_m) continue;
    field.plots.push_back(
        {.top_m = features.top_m, .features = std::move(features.values), .truth = plot.truth});
  }
  return field;
}

heights::Calibration fit(std::span<const MeasuredField> fields) {
  heights::Calibration calibration{.features = heights::feature_names(), .center = {}, .scale = {}};
  for (const MeasuredField& field : fields) calibration.farms.push_back(farm_of(field));
  const auto count = static_cast<Eigen::Index>(calibration.features.size());
  calibration.center = Eigen::VectorXd::Zero(count);
  calibration.scale = Eigen::VectorXd::Ones(count);
  const Eigen::MatrixXd plain = calibration.scaled_farms();
  calibration.center = plain.colwise().mean();
  const Eigen::MatrixXd centred = plain.rowwise() - calibration.center.transpose();
  calibration.scale = (centred.array().square().colwise().mean().sqrt()).max(kLeastScale);

  const std::vector<int> groups = library_groups(calibration);
  const Eigen::MatrixXd places = calibration.scaled_farms();
  for (const auto& [height, ratio] : calibration.farms.front().ratios) {
    heights::HeightModel& model = calibration.models[height];
    model.covariance = best_covariance(places, calibration.ratios_of(height), groups);
    fit_within(fields, calibration, height, model);
  }
  return calibration;
}

std::vector<LeftOut> leave_library_out(const heights::Calibration& calibration) {
  constexpr double kNormal95 = 1.96;
  const std::vector<int> groups = library_groups(calibration);
  const Eigen::MatrixXd places = calibration.scaled_farms();
  std::map<std::pair<std::string, std::string>, LeftOut> table;
  for (const auto& [height, model] : calibration.models) {
    const Eigen::VectorXd ratios = calibration.ratios_of(height);
    const std::vector<heights::Prediction> predictions =
        heights::Kriging(places, ratios, model.covariance).without_own_group(groups);
    for (std::size_t i = 0; i < predictions.size(); ++i) {
      const double error = predictions[i].value - ratios(static_cast<Eigen::Index>(i));
      for (const std::string& library : {calibration.farms[i].library, std::string("all")}) {
        LeftOut& row = table[{library, height}];
        row.library = library;
        row.height = height;
        row.farms += 1;
        row.rmse += error * error;
        row.bias += error;
        row.inside += std::abs(error) < kNormal95 * predictions[i].sd ? 1 : 0;
      }
    }
  }
  std::vector<LeftOut> rows;
  for (auto& [key, row] : table) {
    const auto farms = static_cast<double>(row.farms);
    row.rmse = std::sqrt(row.rmse / farms);
    row.bias /= farms;
    row.inside /= farms;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace plotscan::calibration
