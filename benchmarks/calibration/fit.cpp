// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/fit_covariance.h"
#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

#include "core/random.h"
#include "core/statistics.h"
#include "heights/crop_model.h"
#include "heights/features.h"
#include "heights/known_returns.h"
#include "heights/ratio_model.h"

namespace plotscan::calibration {
namespace {

// A plot's difference from its field's medians: its scaled features', and its ratios'.
struct Differences {
  Eigen::MatrixXd features;  // a row a plot
  Eigen::MatrixXd ratios;
};

Eigen::VectorXd ratios_of(const MeasuredPlot& plot, const heights::Calibration& calibration) {
  Eigen::VectorXd ratios(static_cast<Eigen::Index>(calibration.heights.size()));
  for (std::size_t k = 0; k < calibration.heights.size(); ++k)
    ratios(static_cast<Eigen::Index>(k)) = plot.truth.at(calibration.heights[k]) / plot.top_m;
  return ratios;
}

Differences differences(const MeasuredField& field, const heights::CalibrationFarm& farm,
                        const heights::Calibration& calibration) {
  const auto plots = static_cast<Eigen::Index>(field.plots.size());
  Differences own{.features = Eigen::MatrixXd(plots, calibration.center.size()),
                  .ratios = Eigen::MatrixXd(plots, farm.ratios.size())};
  const Eigen::VectorXd middle = calibration.scaled(farm.features);
  for (Eigen::Index i = 0; i < plots; ++i) {
    const MeasuredPlot& plot = field.plots[static_cast<std::size_t>(i)];
    own.features.row(i) = calibration.scaled(plot.features) - middle;
    own.ratios.row(i) = ratios_of(plot, calibration) - farm.ratios;
  }
  return own;
}

// Each height's spread that the weights of the differences leave, over a farm's plots.
Eigen::VectorXd spread_left(const Differences& own, const Eigen::MatrixXd& within) {
  const Eigen::MatrixXd left = own.ratios - own.features * within.transpose();
  return left.cwiseAbs2().colwise().mean().cwiseSqrt();
}

// Weights of the differences by ridge regression, and each farm's residual spread. The larger a
// farm's residuals, the less it counts; otherwise a lodged plot or a crease of the ground would
// outweigh all even fields.
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
    ratios.push_back(ratios_of(plot, calibration));
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

const std::string& name_of(const heights::CalibrationFarm& farm, Group group) {
  return group == Group::crop ? farm.crop : farm.library;
}

// The farms' numbers in groups.
std::vector<std::vector<std::size_t>> groups_of(const heights::Calibration& calibration,
                                                Group group) {
  std::map<std::string, std::vector<std::size_t>> by_name;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i) {
    by_name[group == Group::farm ? std::to_string(i) : name_of(calibration.farms[i], group)]
        .push_back(i);
  }
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(by_name.size());
  for (auto& [name, farms] : by_name) groups.push_back(std::move(farms));
  return groups;
}

// Fits the kernel that recognises crops, on every second farm, as CropModel does.
heights::Kernel fit_crop_kernel(const heights::Calibration& calibration) {
  const heights::Calibration half = calibration.halved();
  return fit_kernel(half.features_of_farms(), heights::crop_indicators(half),
                    std::vector<double>(half.farms.size(), 1));
}

std::vector<heights::Kernel> fit_ratio_kernels(const heights::Calibration& calibration) {
  std::vector<heights::Kernel> of_crops(calibration.crops.size());
  tbb::parallel_for(std::size_t{0}, of_crops.size(), [&](std::size_t i) {
    const heights::Calibration own = calibration.of_crop(calibration.crops[i]);
    of_crops[i] = fit_kernel(own.features_of_farms(), own.ratios(), own.noise());
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

// Sets each farm's novelty, as seen from the other farms.
void find_unlikeness(heights::Calibration& calibration) {
  const heights::Calibration all = calibration;
  tbb::parallel_for(std::size_t{0}, calibration.farms.size(), [&](std::size_t i) {
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

// Probabilities of the crops that the other farms have; a crop that was left out gets none.
Eigen::VectorXd known_crops(const heights::Calibration& others, Eigen::VectorXd probabilities) {
  for (std::size_t i = 0; i < others.crops.size(); ++i) {
    if (std::ranges::none_of(others.farms, [&](const heights::CalibrationFarm& farm) {
          return farm.crop == others.crops[i];
        }))
      probabilities(static_cast<Eigen::Index>(i)) = 0;
  }
  return probabilities / probabilities.sum();
}

// Farms that others are predicted from.
class Predictors {
 public:
  explicit Predictors(heights::Calibration farms)
      : farms_(std::move(farms)), model_(farms_), crops_(farms_) {}

  // Sets what the farm, which is of another library or crop, is missed by.
  void surprise(heights::CalibrationFarm& farm, Group group) const {
    const Eigen::VectorXd scaled = farms_.scaled(farm.features);
    const Eigen::VectorXd told = known_crops(farms_, crops_.probabilities(scaled));
    auto& from_others = group == Group::crop ? farm.from_crops : farm.from_libraries;
    from_others.novelty = crops_.novelty(scaled);
    from_others.standardised = standardised_errors(farm, model_.mixture(scaled, farm.top_m, told));
    if (group == Group::library)
      farm.standardised_given_crop = standardised_errors(farm, of_its_crop(farm));
  }
  heights::Prediction of_its_crop(const heights::CalibrationFarm& farm) const {
    return model_.mixture(farms_.scaled(farm.features), farm.top_m,
                          farms_.indicators_of(farm.crop));
  }

 private:
  heights::Calibration farms_;
  heights::RatioModel model_;
  heights::CropModel crops_;
};

// Predicts each farm's ratios from farms of other libraries or other crops, since a user's plants
// are of no library.
void find_surprises(heights::Calibration& calibration, Group group) {
  const heights::Calibration all = calibration;
  const std::vector<std::vector<std::size_t>> groups = groups_of(all, group);
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    const Predictors others(all.without(groups[g]));
    for (const std::size_t i : groups[g]) others.surprise(calibration.farms[i], group);
  });
}

// A share of the returns, drawn for the farm: all of half of the farms, else 1 to 1/30, but about
// 100 a square metre.
double kept_share(const FieldSample& sample) {
  constexpr double kLeast_m2 = 100;
  RandomStream random(sample.seed, random_purpose("calibration/thinned"), 0);
  if (random.uniform() < 0.5) return 1;
  const double share = std::pow(10, -random.uniform(0, 1.5));
  double returns = 0;
  double area_m2 = 0;
  for (const PlotSample& plot : sample.plots) {
    returns += static_cast<double>(plot.points.size());
    area_m2 += plot.box.area_m2();
  }
  return std::max(share, kLeast_m2 * area_m2 / std::max(1.0, returns));
}

std::vector<Eigen::Vector3f> thinned(const PlotSample& plot, double share, std::uint64_t seed,
                                     std::size_t number) {
  RandomStream random(seed, random_purpose("calibration/thin"), number);
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3f& point : plot.points)
    if (random.uniform() < share) kept.push_back(point);
  return kept;
}

// A farm as the other farms predict it.
struct ByOthers {
  heights::FieldRatios told, given;
};

void add(double error_m, double sd_m, Errors& errors) {
  errors.rmse_m += error_m * error_m;
  errors.bias_m += error_m;
  errors.inside += std::abs(error_m) < heights::kIntervalErrors * sd_m ? 1 : 0;
}

void finish(std::size_t farms, Errors& errors) {
  const auto count = static_cast<double>(farms);
  errors = {.rmse_m = std::sqrt(errors.rmse_m / count),
            .bias_m = errors.bias_m / count,
            .inside = errors.inside / count};
}

// A row for each height of a library, of a crop, and of all.
std::vector<LeftOut> table_of(const heights::Calibration& calibration,
                              const std::vector<ByOthers>& predictions) {
  std::map<std::pair<std::string, std::string>, LeftOut> table;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const heights::CalibrationFarm& farm = calibration.farms[i];
    for (std::size_t k = 0; k < calibration.heights.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const auto add_to = [&](const heights::FieldRatios& ratios, Errors& errors) {
        add(farm.top_m * (ratios.values(at) - farm.ratios(at)), farm.top_m * ratios.field_sds(at),
            errors);
      };
      const std::string& height = calibration.heights[k];
      for (const std::string& name : {farm.library, farm.crop, std::string("all")}) {
        LeftOut& row =
            table
                .try_emplace({name, height},
                             LeftOut{.name = name, .height = height, .told = {}, .given = {}})
                .first->second;
        ++row.farms;
        add_to(predictions[i].told, row.told);
        add_to(predictions[i].given, row.given);
      }
    }
  }
  std::vector<LeftOut> rows;
  for (auto& [key, row] : table) {
    finish(row.farms, row.told);
    finish(row.farms, row.given);
    rows.push_back(row);
  }
  return rows;
}

// The farms' numbers that are of the crop.
std::vector<std::size_t> farms_of_crop(const heights::Calibration& calibration,
                                       const std::string& crop) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    if (calibration.farms[i].crop == crop) numbers.push_back(i);
  return numbers;
}

// Fits the kernel of a crop, and sets what its new farms, from number `first` on, are missed by.
void extend_crop(const heights::Calibration& before, std::size_t crop, std::size_t first,
                 heights::Calibration& extended) {
  const std::string& name = before.crops[crop];
  const Predictors all(before);
  const Predictors other_crops(before.without(farms_of_crop(before, name)));
  for (std::size_t i = first; i < extended.farms.size(); ++i) {
    heights::CalibrationFarm& farm = extended.farms[i];
    if (farm.crop != name) continue;
    all.surprise(farm, Group::library);
    other_crops.surprise(farm, Group::crop);
    farm.novelty = all.of_its_crop(farm).novelty;
  }
  const heights::Calibration own = extended.of_crop(name);
  extended.ratio_kernels[crop] = fit_kernel(own.features_of_farms(), own.ratios(), own.noise());
}

}  // namespace

MeasuredField measure(const FieldSample& sample, Returns returns) {
  constexpr double kLeastTop_m = 0.05;
  MeasuredField field{.library = sample.library, .plots = {}};
  const bool perfect = returns == Returns::perfect;
  const double noise_m = perfect ? 0 : sample.surface.noise_m;
  const double share = kept_share(sample);
  for (std::size_t i = 0; i < sample.plots.size(); ++i) {
    const PlotSample& plot = sample.plots[i];
    const std::vector<Eigen::Vector3f> points =
        perfect ? plot.perfect : thinned(plot, share, sample.seed, i);
    if (points.empty()) continue;
    const heights::KnownReturns known = heights::known_returns(plot.box, points, sample.surface);
    heights::CanopyFeatures features =
        heights::see_canopy(plot.box, perfect ? points : known.points, noise_m, known.ground.slope)
            .features;
    if (features.top_m < kLeastTop_m) continue;
    field.plots.push_back(
        {.top_m = features.top_m, .features = std::move(features.values), .truth = plot.truth});
  }
  return field;
}

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
  calibration.crops = crops_of(calibration.farms);
  scale_features(calibration);
  calibration.crop_kernel = fit_crop_kernel(calibration);
  calibration.crop_sharpness = likeliest_sharpness(calibration);
  calibration.ratio_kernels = fit_ratio_kernels(calibration);
  find_unlikeness(calibration);
  find_surprises(calibration, Group::library);
  find_surprises(calibration, Group::crop);
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
    farm.within = spread_left(differences(field, farm, calibration), calibration.within);
    calibration.farms.push_back(std::move(farm));
  }
  for (const std::size_t crop : crops) extend_crop(before, crop, before.farms.size(), calibration);
  return calibration;
}

std::vector<LeftOut> leave_out(const heights::Calibration& calibration, Group group) {
  const std::vector<std::vector<std::size_t>> left_out = groups_of(calibration, group);
  std::vector<ByOthers> predictions(calibration.farms.size());
  tbb::parallel_for(std::size_t{0}, left_out.size(), [&](std::size_t g) {
    const heights::Calibration others = calibration.without(left_out[g]);
    const heights::RatioModel model(others);
    const heights::CropModel crops(others);
    for (const std::size_t i : left_out[g]) {
      const heights::CalibrationFarm& farm = calibration.farms[i];
      const Eigen::VectorXd scaled = others.scaled(farm.features);
      const auto ratios = [&](const Eigen::VectorXd& probabilities, bool given) {
        return model.at(
            scaled, farm.top_m,
            {.probabilities = probabilities, .novelty = crops.novelty(scaled), .given = given});
      };
      predictions[i] = {.told = ratios(known_crops(others, crops.probabilities(scaled)), false),
                        .given = ratios(others.indicators_of(farm.crop), true)};
    }
  });
  return table_of(calibration, predictions);
}

}  // namespace plotscan::calibration
