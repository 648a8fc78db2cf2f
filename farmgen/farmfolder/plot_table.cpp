// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/plot_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/plot_features.h"
#include "core/text_file.h"

namespace plotscan::farmfolder {
namespace {

template <class Heights>
struct Attribute {
  const char* name;
  double Heights::*value;
};

constexpr std::array<Attribute<farm::PlotHeights>, 7> kHeights = {
    {{"height_mean_m", &farm::PlotHeights::mean},
     {"height_max_m", &farm::PlotHeights::max},
     {"height_p50_m", &farm::PlotHeights::p50},
     {"height_p90_m", &farm::PlotHeights::p90},
     {"height_p95_m", &farm::PlotHeights::p95},
     {"height_p99_m", &farm::PlotHeights::p99},
     {"height_hand3_m", &farm::PlotHeights::hand3}}};

constexpr std::array<Attribute<farm::CanopyHeights>, 2> kCanopies = {
    {{"canopy_p95_m", &farm::CanopyHeights::p95}, {"canopy_p99_m", &farm::CanopyHeights::p99}}};

// The attributes of one feature, with errors that name the file and the feature.
class Attributes {
 public:
  Attributes(const std::filesystem::path& file, std::size_t feature, const nlohmann::json& values)
      : file_(file), feature_(feature), values_(values) {}

  bool has(const char* name) const { return values_.contains(name); }

  double number(const char* name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || !found->is_number()) fail(name, "is missing or not a number");
    const double value = found->get<double>();
    if (!std::isfinite(value)) fail(name, "is not finite");
    return value;
  }

  std::string text(const char* name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || !found->is_string()) fail(name, "is missing or not a text");
    return found->get<std::string>();
  }

  std::uint32_t whole(const char* name, int low) const {
    const double value = number(name);
    if (value != std::floor(value) || value < low || value > kMost)
      fail(name, fmt::format("is not a whole number in [{}, {:.0f}]", low, kMost));
    return static_cast<std::uint32_t>(value);
  }

  // The number, from 1; the fallback where there is none.
  std::uint32_t whole_or(const char* name, std::uint32_t fallback) const {
    return has(name) ? whole(name, 1) : fallback;
  }

 private:
  static constexpr double kMost = std::numeric_limits<std::int32_t>::max();

  [[noreturn]] void fail(const char* name, const std::string& what) const {
    throw InputError(file_, "feature {}: {} {}", feature_, name, what);
  }

  const std::filesystem::path& file_;
  std::size_t feature_;
  const nlohmann::json& values_;
};

// The attributes of a plot in truth/plots.geojson, besides its box (docs/farm-format.md).
nlohmann::json plot_attributes(const farm::Plot& plot) {
  nlohmann::json attributes = {
      {"plot_number", plot.id},     {"row_number", plot.row},
      {"col_number", plot.column},  {"rep_number", plot.rep},
      {"block_number", plot.block}, {"accession_name", plot.accession},
      {"plants", plot.plant_count}, {"plants_missing", plot.missing_plants},
      {"weeds", plot.weed_count},   {"lodging_deg", plot.lodging_rad / kDegrees}};
  if (plot.trial > 0) attributes["trial_number"] = plot.trial;
  for (const auto& [name, value] : kHeights) attributes[name] = plot.heights.*value;
  if (plot.canopy)
    for (const auto& [name, value] : kCanopies) attributes[name] = *plot.canopy.*value;
  return attributes;
}

// Absent where the farm was made without.
std::optional<farm::CanopyHeights> canopy_of(const Attributes& attributes) {
  if (!attributes.has(kCanopies.front().name)) return std::nullopt;
  farm::CanopyHeights canopy;
  for (const auto& [name, value] : kCanopies) canopy.*value = attributes.number(name);
  return canopy;
}

std::vector<PlotFeature> features_of(const std::vector<farm::Plot>& plots) {
  return list_of(plots, [](const farm::Plot& plot) {
    return PlotFeature{.box = plot.box, .properties = plot_attributes(plot)};
  });
}

// The plot with that box at the `place` in its file. If it is not `whole`, its box counts, and
// numbers that it lacks are replaced.
farm::Plot plot_of(const Attributes& attributes, const PlotBox& box, std::uint32_t place,
                   bool whole) {
  const auto number = [&](const char* name, std::uint32_t otherwise) {
    return whole ? attributes.whole(name, 1) : attributes.whole_or(name, otherwise);
  };
  farm::Plot plot{.id = number("plot_number", place),
                  .trial = static_cast<int>(attributes.whole_or("trial_number", 0)),
                  .row = static_cast<int>(number("row_number", 1)),
                  .column = static_cast<int>(number("col_number", place)),
                  .box = box,
                  .plant_count = whole ? attributes.whole("plants", 0) : 0,
                  .heights = {},
                  .rep = static_cast<int>(number("rep_number", 1)),
                  .block = static_cast<int>(number("block_number", 1))};
  if (whole || attributes.has("accession_name")) plot.accession = attributes.text("accession_name");
  if (!whole) return plot;
  plot.missing_plants = attributes.whole("plants_missing", 0);
  plot.weed_count = attributes.whole("weeds", 0);
  plot.lodging_rad = attributes.number("lodging_deg") * kDegrees;
  for (const auto& [name, value] : kHeights) plot.heights.*value = attributes.number(name);
  plot.canopy = canopy_of(attributes);
  return plot;
}

std::vector<farm::Plot> plots_in(const std::filesystem::path& path, bool whole) {
  std::vector<farm::Plot> plots;
  std::unordered_set<std::uint32_t> ids;
  for (const PlotFeature& feature : read_plot_features(path)) {
    const auto place = static_cast<std::uint32_t>(plots.size() + 1);
    plots.push_back(plot_of({path, place, feature.properties}, feature.box, place, whole));
  }
  for (const farm::Plot& plot : plots)
    if (!ids.insert(plot.id).second) throw InputError(path, "plot {} is given twice", plot.id);
  return plots;
}

}  // namespace

void write_plots(const std::filesystem::path& path, const std::vector<farm::Plot>& plots) {
  write_plot_features(path, features_of(plots));
}

void write_plots_wgs84(const std::filesystem::path& path, const std::vector<farm::Plot>& plots,
                       const Anchor& anchor) {
  write_plot_features_wgs84(path, features_of(plots), [&](const Eigen::Vector2d& corner) {
    const GeodeticPoint point = geodetic_from_world(anchor, {corner.x(), corner.y(), 0});
    return Eigen::Vector2d(point.longitude_deg, point.latitude_deg);
  });
}

std::vector<farm::Plot> read_plots(const std::filesystem::path& path) {
  return plots_in(path, true);
}

std::vector<farm::Plot> read_plot_boxes(const std::filesystem::path& path) {
  return plots_in(path, false);
}

void write_trial_layout(const std::filesystem::path& path, const std::string& trial,
                        const std::vector<farm::Plot>& plots) {
  const bool several_trials =
      std::ranges::any_of(plots, [](const farm::Plot& plot) { return plot.trial > 0; });
  TextFile out(path);
  out << "plot_name,accession_name,plot_number," << (several_trials ? "trial_number," : "")
      << "block_number,rep_number,row_number,col_number,"
         "center_x_m,center_y_m,width_m,length_m,heading_deg\n";
  for (const farm::Plot& plot : plots) {
    out << trial << "_" << plot.id << "," << csv_field(plot.accession) << "," << plot.id << ",";
    if (several_trials) out << plot.trial << ",";
    out << plot.block << "," << plot.rep << "," << plot.row << "," << plot.column;
    for (const double value : {plot.box.center.x(), plot.box.center.y(), plot.box.width_m,
                               plot.box.length_m, plot.box.heading_rad / kDegrees})
      out << "," << value;
    out << "\n";
  }
  out.close();
}

}  // namespace plotscan::farmfolder
