// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include "core/statistics.h"
#include "heights/features.h"
#include "heights/plot_ground.h"
#include "heights/ratio_model.h"

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
double surprise_without(const heights::Kriging& kriging, const Eigen::VectorXd& ratios,
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

// The same for new plants of a known kind and for those of a new one, half and half.
double surprise(const heights::Kriging& kriging, const Eigen::VectorXd& ratios,
                std::span<const int> groups) {
  std::vector<int> each_alone(groups.size());
  std::iota(each_alone.begin(), each_alone.end(), 0);
  return 0.5 * (surprise_without(kriging, ratios, groups) +
                surprise_without(kriging, ratios, each_alone));
}

// A covariance, and by what the noise was multiplied for it.
struct FittedCovariance {
  Covariance covariance;
  double noise_factor = 1;
};

std::vector<double> scaled_by(std::vector<double> noise, double factor) {
  for (double& sd : noise) sd *= factor;
  return noise;
}

// Pattern search over the logarithms of the four numbers (Hooke and Jeeves 1961, its exploratory
// moves).
FittedCovariance best_covariance(const Eigen::MatrixXd& places, const Eigen::VectorXd& ratios,
                                 const std::vector<double>& noise, std::span<const int> groups) {
  const auto fitted = [](const std::array<double, 4>& logs) {
    return FittedCovariance{.covariance = {.signal = std::exp(logs[0]),
                                           .length = std::exp(logs[1]),
                                           .linear = std::exp(logs[2])},
                            .noise_factor = std::exp(logs[3])};
  };
  const auto cost = [&](const std::array<double, 4>& logs) {
    const FittedCovariance tried = fitted(logs);
    return surprise(
        heights::Kriging(places, ratios, scaled_by(noise, tried.noise_factor), tried.covariance),
        ratios, groups);
  };
  std::array<double, 4> best = {std::log(0.08), std::log(1.0), std::log(0.05), 0};
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
  return fitted(best);
}

// The noise of each farm's ratio: first alike, then in proportion to the errors of the farms most
// like it, each predicted by the others. Some crops show their plants better than others.
void fit_between(const std::string& height, std::span<const int> groups,
                 heights::Calibration& calibration) {
  constexpr double kFirstNoise = 0.025;
  constexpr double kLeastNoise = 0.008;
  constexpr int kRounds = 2;
  const Eigen::MatrixXd places = calibration.scaled_farms();
  const Eigen::VectorXd ratios = calibration.ratios_of(height);
  std::vector<double> noise(calibration.farms.size(), kFirstNoise);
  FittedCovariance fitted = best_covariance(places, ratios, noise, groups);
  std::vector<int> each_alone(noise.size());
  std::iota(each_alone.begin(), each_alone.end(), 0);
  for (int round = 0; round < kRounds; ++round) {
    const heights::Kriging kriging(places, ratios, scaled_by(noise, fitted.noise_factor),
                                   fitted.covariance);
    const std::vector<heights::Prediction> others = kriging.without_own_group(each_alone);
    std::vector<double> errors;
    for (std::size_t i = 0; i < others.size(); ++i)
      errors.push_back(others[i].value - ratios(static_cast<Eigen::Index>(i)));
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] = std::max(kLeastNoise,
                          kriging.local_spread(places.row(static_cast<Eigen::Index>(i)), errors));
    }
    fitted = best_covariance(places, ratios, noise, groups);
  }
  calibration.models[height].covariance = fitted.covariance;
  for (std::size_t i = 0; i < noise.size(); ++i)
    calibration.farms[i].noise[height] = noise[i] * fitted.noise_factor;
}

// A plot's difference from its field's medians: its scaled features', and its ratio's.
struct Difference {
  Eigen::VectorXd features;
  double ratio = 0;
};

Difference difference(const MeasuredPlot& plot, const heights::Calibration& calibration,
                      const heights::CalibrationFarm& farm, const std::string& height) {
  return {.features = calibration.scaled(plot.features) - calibration.scaled(farm.features),
          .ratio = plot.truth.at(height) / plot.top_m - farm.ratios.at(height)};
}

// The weights of the differences by ridge regression, and what they leave of each farm's.
void fit_within(std::span<const MeasuredField> fields, const std::string& height,
                heights::Calibration& calibration) {
  const Eigen::Index count = calibration.center.size();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  double plots = 0;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (const MeasuredPlot& plot : fields[f].plots) {
      const Difference own = difference(plot, calibration, calibration.farms[f], height);
      normal += own.features * own.features.transpose();
      right += own.features * own.ratio;
      plots += 1;
    }
  }
  const Eigen::MatrixXd ridged = normal + plots * kRidge * Eigen::MatrixXd::Identity(count, count);
  const Eigen::VectorXd weights = ridged.ldlt().solve(right);
  calibration.models[height].within = weights;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    double squares = 0;
    for (const MeasuredPlot& plot : fields[f].plots) {
      const Difference own = difference(plot, calibration, calibration.farms[f], height);
      squares += std::pow(own.ratio - weights.dot(own.features), 2);
    }
    calibration.farms[f].within[height] =
        std::sqrt(squares / static_cast<double>(fields[f].plots.size()));
  }
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

std::set<std::string> libraries_of(const heights::Calibration& calibration) {
  std::set<std::string> libraries;
  for (const heights::CalibrationFarm& farm : calibration.farms) libraries.insert(farm.library);
  return libraries;
}

void add(double error, bool inside, LeftOut& row) {
  row.farms += 1;
  row.rmse += error * error;
  row.bias += error;
  row.inside += inside ? 1 : 0;
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
  for (const auto& [height, ratio] : calibration.farms.front().ratios) {
    fit_between(height, groups, calibration);
    fit_within(fields, height, calibration);
  }
  return calibration;
}

std::vector<LeftOut> leave_library_out(const heights::Calibration& calibration) {
  constexpr double kQuantile95 = 2.064;
  std::map<std::pair<std::string, std::string>, LeftOut> table;
  for (const std::string& library : libraries_of(calibration)) {
    heights::Calibration others = calibration;
    std::erase_if(others.farms, [&](const auto& farm) { return farm.library == library; });
    for (const auto& [height, model] : calibration.models) {
      const heights::RatioModel ratios(others, height);
      for (const heights::CalibrationFarm& farm : calibration.farms) {
        if (farm.library != library) continue;
        const heights::FieldRatio found = ratios.at(calibration.scaled(farm.features));
        const double error = found.value - farm.ratios.at(height);
        for (const std::string& name : {library, std::string("all")})
          add(error, std::abs(error) < kQuantile95 * found.field_sd,
              table.try_emplace({name, height}, LeftOut{.library = name, .height = height})
                  .first->second);
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
