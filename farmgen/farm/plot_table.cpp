// SPDX-License-Identifier: Apache-2.0
#include "farm/plot_table.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>

#include "core/error.h"
#include "core/plot_features.h"

namespace plotscan::farm {
namespace {

struct HeightAttribute {
  const char* name;
  double PlotHeights::*value;
};
constexpr std::array<HeightAttribute, 7> kHeights = {{{"height_mean_m", &PlotHeights::mean},
                                                      {"height_max_m", &PlotHeights::max},
                                                      {"height_p50_m", &PlotHeights::p50},
                                                      {"height_p90_m", &PlotHeights::p90},
                                                      {"height_p95_m", &PlotHeights::p95},
                                                      {"height_p99_m", &PlotHeights::p99},
                                                      {"height_hand3_m", &PlotHeights::hand3}}};

// The attributes of one feature, with errors that name the file and the feature.
class Attributes {
 public:
  Attributes(const std::filesystem::path& file, std::size_t feature, const nlohmann::json& values)
      : file_(file), feature_(feature), values_(values) {}

  double number(const char* name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || !found->is_number()) fail(name, "is missing or not a number");
    const double value = found->get<double>();
    if (!std::isfinite(value)) fail(name, "is not finite");
    return value;
  }

  std::uint32_t whole(const char* name, double low) const {
    const double value = number(name);
    if (value != std::floor(value) || value < low || value > kMost) {
      fail(name, "is not a whole number in [" + std::to_string(static_cast<int>(low)) + ", " +
                     std::to_string(static_cast<std::uint32_t>(kMost)) + "]");
    }
    return static_cast<std::uint32_t>(value);
  }

 private:
  static constexpr double kMost = std::numeric_limits<std::int32_t>::max();

  [[noreturn]] void fail(const char* name, const std::string& what) const {
    throw InputError(file_, "feature " + std::to_string(feature_) + ": " + name + " " + what);
  }

  const std::filesystem::path& file_;
  std::size_t feature_;
  const nlohmann::json& values_;
};

void require_different_ids(const std::filesystem::path& path, const std::vector<Plot>& plots) {
  std::unordered_set<std::uint32_t> ids;
  for (const Plot& plot : plots) {
    if (!ids.insert(plot.id).second)
      throw InputError(path, "plot " + std::to_string(plot.id) + " is given twice");
  }
}

std::vector<PlotFeature> features_of(const std::vector<Plot>& plots) {
  std::vector<PlotFeature> features;
  features.reserve(plots.size());
  for (const Plot& plot : plots) {
    PlotFeature feature{.box = plot.box};
    feature.properties["plot"] = plot.id;
    feature.properties["row"] = plot.row;
    feature.properties["column"] = plot.column;
    feature.properties["plants"] = plot.plant_count;
    for (const auto& [name, value] : kHeights) feature.properties[name] = plot.heights.*value;
    features.push_back(std::move(feature));
  }
  return features;
}

}  // namespace

void write_plots(const std::filesystem::path& path, const std::vector<Plot>& plots) {
  write_plot_features(path, features_of(plots));
}

void write_plots_wgs84(const std::filesystem::path& path, const std::vector<Plot>& plots,
                       const Anchor& anchor) {
  write_plot_features_wgs84(path, features_of(plots), [&](const Eigen::Vector2d& corner) {
    const GeodeticPoint point = geodetic_from_world(anchor, {corner.x(), corner.y(), 0});
    return Eigen::Vector2d(point.longitude_deg, point.latitude_deg);
  });
}

std::vector<Plot> read_plots(const std::filesystem::path& path) {
  std::vector<Plot> plots;
  for (const PlotFeature& feature : read_plot_features(path)) {
    const Attributes attributes(path, plots.size() + 1, feature.properties);
    Plot plot{.id = attributes.whole("plot", 1),
              .row = static_cast<int>(attributes.whole("row", 1)),
              .column = static_cast<int>(attributes.whole("column", 1)),
              .box = feature.box,
              .plant_count = attributes.whole("plants", 0),
              .heights = {}};
    for (const auto& [name, value] : kHeights) plot.heights.*value = attributes.number(name);
    plots.push_back(plot);
  }
  require_different_ids(path, plots);
  return plots;
}

std::vector<Plot> read_plot_boxes(const std::filesystem::path& path) {
  std::vector<Plot> plots;
  for (const PlotFeature& feature : read_plot_features(path)) {
    const auto place = static_cast<std::uint32_t>(plots.size() + 1);
    const Attributes attributes(path, place, feature.properties);
    const auto whole_or = [&](const char* name, std::uint32_t fallback) {
      return feature.properties.contains(name) ? attributes.whole(name, 1) : fallback;
    };
    plots.push_back({.id = whole_or("plot", place),
                     .row = static_cast<int>(whole_or("row", 1)),
                     .column = static_cast<int>(whole_or("column", place)),
                     .box = feature.box,
                     .plant_count = 0,
                     .heights = {}});
  }
  require_different_ids(path, plots);
  return plots;
}

}  // namespace plotscan::farm
