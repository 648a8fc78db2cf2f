// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

#include "calibration/farm_groups.h"
#include "calibration/fit_covariance.h"
#include "calibration/fit_within.h"
#include "core/error.h"
#include "core/statistics.h"
#include "heights/crop_model.h"
#include "heights/features.h"
#include "heights/ratio_model.h"

namespace plotscan::calibration {
namespace {

// "soybean" of "soybean-r2".
std::string crop_of(const std::string& library) { return library.substr(0, library.find('-')); }

std::vector<std::string> crops_of(std::span<const heights::CalibrationFarm> farms) {
  std::set<std::string> crops;
  for (const heights::CalibrationFarm& farm : farms) crops.insert(farm.crop);
  return {crops.begin(), crops.end()};
}

heights::CalibrationFarm farm_of(const MeasuredField& field,
                                 const heights::Calibration& calibration) {
  std::vector<Eigen::VectorXd> features;
  std::vector<Eigen::VectorXd> ratios;
  std::vector<double> tops;
  for (const MeasuredPlot& plot : field.plots) {
    features.push_back(plot.features);
    ratios.push_back(ratios_of(plot, calibration.heights));
    tops.push_back(plot.top_m);
  }
  return {.library = field.library,
          .crop = crop_of(field.library),
          .top_m = quantile(tops, 0.5),
          .features = heights::field_features(features),
          .ratios = heights::field_features(ratios),
          .within = {},
          .from_libraries = {},
          .from_crops = {},
          .standardised_given_crop = {}};
}

// Each library and each crop is left out once, and something must be left then.
void check_libraries(const heights::Calibration& calibration) {
  std::map<std::string, std::set<std::string>> libraries;
  for (const heights::CalibrationFarm& farm : calibration.farms)
    libraries[farm.crop].insert(farm.library);
  if (libraries.size() < 2) throw InputError("a calibration needs farms of at least two crops");
  for (const auto& [crop, of_crop] : libraries) {
    if (of_crop.size() < 2) {
      throw InputError("a calibration needs at least two plant libraries of each crop: " + crop +
                       " has one, " + *of_crop.begin());
    }
  }
}

void scale_features(heights::Calibration& calibration) {
  constexpr double kLeastScale = 1e-6;  // of a feature that never varies
  const auto farms = static_cast<Eigen::Index>(calibration.farms.size());
  Eigen::MatrixXd plain(farms, static_cast<Eigen::Index>(calibration.features.size()));
  for (Eigen::Index i = 0; i < farms; ++i)
    plain.row(i) = calibration.farms[static_cast<std::size_t>(i)].features;
  calibration.center = plain.colwise().mean();
  const Eigen::MatrixXd centred = plain.rowwise() - calibration.center.transpose();
  calibration.scale = (centred.array().square().colwise().mean().sqrt()).max(kLeastScale);
}

// Fits the kernel that recognises crops, on every second farm, as CropModel does.
heights::Kernel fit_crop_kernel(const heights::Calibration& calibration) {
  const heights::Calibration half = calibration.halved();
  return fit_kernel(half.features_of_farms(), heights::crop_indicators(half),
                    std::vector<double>(half.farms.size(), 1));
}

heights::Kernel fit_ratio_kernel(const heights::Calibration& calibration, const std::string& crop) {
  const heights::Calibration own = calibration.of_crop(crop);
  return fit_kernel(own.features_of_farms(), own.ratios(), own.noise());
}

std::vector<heights::Kernel> fit_ratio_kernels(const heights::Calibration& calibration) {
  std::vector<heights::Kernel> of_crops(calibration.crops.size());
  tbb::parallel_for(std::size_t{0}, of_crops.size(), [&](std::size_t i) {
    of_crops[i] = fit_ratio_kernel(calibration, calibration.crops[i]);
  });
  return of_crops;
}

// The sharpness under which the true crops are likeliest, each farm judged by the farms of other
// libraries.
double likeliest_sharpness(const heights::Calibration& calibration) {
  std::vector<Eigen::VectorXd> scores(calibration.farms.size());
  const std::vector<std::vector<std::size_t>> libraries = groups_of(calibration, Group::library);
  tbb::parallel_for(std::size_t{0}, libraries.size(), [&](std::size_t g) {
    const heights::CropModel others(calibration.without(libraries[g]));
    for (const std::size_t i : libraries[g])
      scores[i] = others.scores(calibration.scaled(calibration.farms[i].features));
  });
  double best = 1, most = -INFINITY;
  constexpr double kLeast = 0.1, kStep = 1.05;
  constexpr int kTried = 95;  // up to 10
  for (int step = 0; step < kTried; ++step) {
    const double sharpness = kLeast * std::pow(kStep, step);
    double likelihood = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const auto own = static_cast<Eigen::Index>(calibration.index_of(calibration.farms[i].crop));
      likelihood += std::log(heights::softmax(scores[i], sharpness)(own));
    }
    if (likelihood <= most) continue;
    most = likelihood;
    best = sharpness;
  }
  return best;
}

// Sets the novelty of the farms from number `first` on, each as seen from all other farms.
void find_unlikeness(heights::Calibration& calibration, std::size_t first) {
  const heights::Calibration all = calibration;
  tbb::parallel_for(first, calibration.farms.size(), [&](std::size_t i) {
    heights::CalibrationFarm& farm = calibration.farms[i];
    const heights::Calibration others = all.without({&i, 1});
    farm.novelty =
        heights::RatioModel(others)
            .mixture(others.scaled(farm.features), farm.top_m, others.indicators_of(farm.crop))
            .novelty;
  });
}

// Errors over standard deviations.
Eigen::VectorXd standardised_errors(const heights::CalibrationFarm& farm,
                                    const heights::Prediction& prediction) {
  return (farm.ratios - prediction.values).cwiseQuotient(prediction.sds);
}

// Predicts the ratios of the farms from number `first` on, each from farms of other libraries or
// other crops, since a user's plants are of no library.
void find_surprises(heights::Calibration& calibration, Group group, std::size_t first) {
  const heights::Calibration all = calibration;
  std::vector<std::vector<std::size_t>> groups = groups_of(all, group);
  std::erase_if(groups, [&](const auto& farms) { return farms.back() < first; });
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    const heights::Calibration others = all.without(groups[g]);
    const heights::RatioModel model(others);
    const heights::CropModel crops(others);
    for (const std::size_t i : groups[g]) {
      if (i < first) continue;
      heights::CalibrationFarm& farm = calibration.farms[i];
      const Eigen::VectorXd scaled = others.scaled(farm.features);
      const Eigen::VectorXd recognised = known_crops(others, crops.probabilities(scaled));
      auto& from_others = group == Group::crop ? farm.from_crops : farm.from_libraries;
      from_others.novelty = crops.novelty(scaled);
      from_others.standardised =
          standardised_errors(farm, model.mixture(scaled, farm.top_m, recognised));
      if (group == Group::library) {
        farm.standardised_given_crop = standardised_errors(
            farm, model.mixture(scaled, farm.top_m, others.indicators_of(farm.crop)));
      }
    }
  });
}

// Sets what the farms from number `first` on are missed by.
void find_misses(heights::Calibration& calibration, std::size_t first) {
  find_unlikeness(calibration, first);
  find_surprises(calibration, Group::library, first);
  find_surprises(calibration, Group::crop, first);
}

}  // namespace

heights::Calibration fit(std::span<const MeasuredField> fields) {
  heights::Calibration calibration{.features = heights::feature_names(),
                                   .center = {},
                                   .scale = {},
                                   .crop_kernel = {},
                                   .within = {}};
  for (const auto& [height, value] : fields.front().plots.front().truth)
    calibration.heights.push_back(height);
  for (const MeasuredField& field : fields)
    calibration.farms.push_back(farm_of(field, calibration));
  check_libraries(calibration);
  calibration.crops = crops_of(calibration.farms);
  scale_features(calibration);
  calibration.crop_kernel = fit_crop_kernel(calibration);
  calibration.crop_sharpness = likeliest_sharpness(calibration);
  calibration.ratio_kernels = fit_ratio_kernels(calibration);
  find_misses(calibration, 0);
  fit_within(fields, calibration);
  return calibration;
}

heights::Calibration extended(const heights::Calibration& before,
                              std::span<const MeasuredField> fields) {
  heights::Calibration calibration = before;
  std::set<std::size_t> crops;
  for (const MeasuredField& field : fields) {
    heights::CalibrationFarm farm = farm_of(field, calibration);
    crops.insert(calibration.index_of(farm.crop));
    farm.within = spread_within(field, farm, calibration);
    calibration.farms.push_back(std::move(farm));
  }
  for (const std::size_t crop : crops)
    calibration.ratio_kernels[crop] = fit_ratio_kernel(calibration, calibration.crops[crop]);
  find_misses(calibration, before.farms.size());
  return calibration;
}

}  // namespace plotscan::calibration
