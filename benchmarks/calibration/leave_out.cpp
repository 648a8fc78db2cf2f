// SPDX-License-Identifier: Apache-2.0
#include "calibration/leave_out.h"

#include <cmath>
#include <map>
#include <utility>

#include <tbb/parallel_for.h>

#include "heights/crop_model.h"
#include "heights/ratio_model.h"

namespace plotscan::calibration {
namespace {

// A farm as the other farms predict it.
struct ByOthers {
  heights::FieldRatios recognised, given;
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
                             LeftOut{.name = name, .height = height, .recognised = {}, .given = {}})
                .first->second;
        ++row.farms;
        add_to(predictions[i].recognised, row.recognised);
        add_to(predictions[i].given, row.given);
      }
    }
  }
  std::vector<LeftOut> rows;
  for (auto& [key, row] : table) {
    finish(row.farms, row.recognised);
    finish(row.farms, row.given);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

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
      predictions[i] = {
          .recognised = ratios(known_crops(others, crops.probabilities(scaled)), false),
          .given = ratios(others.indicators_of(farm.crop), true)};
    }
  });
  return table_of(calibration, predictions);
}

}  // namespace plotscan::calibration
