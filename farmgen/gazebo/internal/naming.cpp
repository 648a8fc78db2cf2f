// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/naming.h"

#include <charconv>

#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace {

constexpr std::string_view kPlot = "plot_";
constexpr std::string_view kPlant = "plant_";

// The number that begins at `begin`, when it ends with the text or, with `may_go_on`, before "_".
std::optional<std::uint32_t> number_at(std::string_view text, std::size_t begin, bool may_go_on) {
  std::uint32_t value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data() + begin, last, value);
  if (error != std::errc() || value == 0) return {};
  if (end != last && !(may_go_on && *end == '_')) return {};
  return value;
}

}  // namespace

std::string row_model_name(int trial, int row) {
  const std::string name = "row_" + std::to_string(row);
  return trial > 0 ? "trial_" + std::to_string(trial) + "_" + name : name;
}

std::string plant_model_name(std::uint32_t plot, std::uint32_t plant) {
  const std::string name = sdfxml::plant_element_name(plant);
  return plot == 0 ? name : sdfxml::plot_element_name(plot) + "_" + name;
}

std::string weeds_name(const std::string& name) { return name + "_weeds"; }

std::string outside_model_name(std::uint32_t tile) {
  return sdfxml::kPlantsOutsidePlots + ("_" + std::to_string(tile));
}

std::optional<std::uint32_t> plot_in_name(std::string_view name) {
  if (!name.starts_with(kPlot)) return {};
  return number_at(name, kPlot.size(), true);
}

std::optional<std::uint32_t> plant_in_name(std::string_view name) {
  const auto begin = name.rfind(kPlant);
  if (begin == std::string_view::npos) return {};
  if (begin != 0 && name[begin - 1] != '_') return {};
  return number_at(name, begin + kPlant.size(), false);
}

}  // namespace plotscan::gazebo
