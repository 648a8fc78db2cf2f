// SPDX-License-Identifier: Apache-2.0
#include "calibration/farm_groups.h"

#include <algorithm>
#include <map>
#include <utility>

namespace plotscan::calibration {
namespace {

std::string group_of(const heights::Calibration& calibration, std::size_t farm, Group group) {
  if (group == Group::farm) return std::to_string(farm);
  return group == Group::crop ? calibration.farms[farm].crop : calibration.farms[farm].library;
}

}  // namespace

std::vector<std::vector<std::size_t>> groups_of(const heights::Calibration& calibration,
                                                Group group) {
  std::map<std::string, std::vector<std::size_t>> by_name;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    by_name[group_of(calibration, i, group)].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(by_name.size());
  for (auto& [name, farms] : by_name) groups.push_back(std::move(farms));
  return groups;
}

Eigen::VectorXd known_crops(const heights::Calibration& others, Eigen::VectorXd probabilities) {
  for (std::size_t i = 0; i < others.crops.size(); ++i) {
    if (std::ranges::none_of(others.farms, [&](const heights::CalibrationFarm& farm) {
          return farm.crop == others.crops[i];
        }))
      probabilities(static_cast<Eigen::Index>(i)) = 0;
  }
  return probabilities / probabilities.sum();
}

}  // namespace plotscan::calibration
