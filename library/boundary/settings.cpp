// SPDX-License-Identifier: Apache-2.0
#include "boundary/settings.h"

#include <cmath>
#include <string_view>

namespace plotscan::boundary {
namespace {

InputError wrong_kind(const std::string& name, std::string_view kind) {
  return InputError(name + " is " + std::string(kind));
}

template <class Kind>
const Kind& as(const std::string& name, const SettingValue& given, std::string_view kind) {
  if (const Kind* held = std::get_if<Kind>(&given)) return *held;
  throw wrong_kind(name, kind);
}

int whole(const std::string& name, double number, std::string_view kind) {
  if (number != std::round(number) || std::abs(number) > 1e6) throw wrong_kind(name, kind);
  return static_cast<int>(number);
}

const std::vector<double>& several(const std::string& name, const SettingValue& given,
                                   std::size_t count, std::string_view kind) {
  const auto& numbers = as<std::vector<double>>(name, given, kind);
  if (numbers.size() != count) throw wrong_kind(name, kind);
  return numbers;
}

}  // namespace

SettingValue outer(double value) { return value; }
SettingValue outer(int value) { return static_cast<double>(value); }
SettingValue outer(bool value) { return value; }
SettingValue outer(const std::string& value) { return value; }
SettingValue outer(const std::vector<int>& values) {
  return std::vector<double>(values.begin(), values.end());
}
SettingValue outer(const std::array<double, 4>& values) {
  return std::vector<double>(values.begin(), values.end());
}
SettingValue outer(const Eigen::Vector3d& values) {
  return std::vector<double>(values.begin(), values.end());
}

void take(const std::string& name, const SettingValue& given, double& value) {
  value = as<double>(name, given, "a number");
}
void take(const std::string& name, const SettingValue& given, int& value) {
  constexpr std::string_view kKind = "a whole number";
  value = whole(name, as<double>(name, given, kKind), kKind);
}
void take(const std::string& name, const SettingValue& given, bool& value) {
  value = as<bool>(name, given, "true or false");
}
void take(const std::string& name, const SettingValue& given, std::string& value) {
  value = as<std::string>(name, given, "a text");
}
void take(const std::string& name, const SettingValue& given, std::vector<int>& values) {
  constexpr std::string_view kKind = "whole numbers";
  values.clear();
  for (const double number : as<std::vector<double>>(name, given, kKind))
    values.push_back(whole(name, number, kKind));
}
void take(const std::string& name, const SettingValue& given, std::array<double, 4>& values) {
  std::ranges::copy(several(name, given, values.size(), "four numbers"), values.begin());
}
void take(const std::string& name, const SettingValue& given, Eigen::Vector3d& values) {
  values = Eigen::Vector3d(several(name, given, 3, "three numbers").data());
}

}  // namespace plotscan::boundary
