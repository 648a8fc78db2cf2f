// SPDX-License-Identifier: Apache-2.0
#include "estimate/plot_map.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/text.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

std::string properties_of(const std::vector<PlotFeature>& plots) {
  std::set<std::string> names;
  for (const PlotFeature& plot : plots) {
    for (const auto& [name, value] : plot.properties.items()) names.insert(name);
  }
  return joined({names.begin(), names.end()}, ", ");
}

// The property in which at least one plot has an id.
std::optional<std::string> id_property_of(const fs::path& file,
                                          const std::vector<PlotFeature>& plots,
                                          const std::optional<std::string>& wanted) {
  const auto names_a_plot = [&](const std::string& property) {
    return std::ranges::any_of(
        plots, [&](const PlotFeature& plot) { return id_in(plot, property).has_value(); });
  };
  if (wanted) {
    if (names_a_plot(*wanted)) return wanted;
    throw InputError(file, "no plot has an id in a property \"" + *wanted +
                               "\"; the plots' properties are: " + properties_of(plots));
  }
  const auto found = std::ranges::find_if(plot_id_properties(), names_a_plot);
  if (found == plot_id_properties().end()) return std::nullopt;
  return *found;
}

std::vector<PlotId> ids_of(const fs::path& file, const std::vector<PlotFeature>& plots,
                           const std::string& property) {
  std::vector<PlotId> ids;
  std::map<PlotId, std::size_t> places;
  for (const PlotFeature& plot : plots) {
    const std::size_t place = ids.size() + 1;
    const std::optional<PlotId> id = id_in(plot, property);
    if (!id) {
      throw InputError(file, "feature " + std::to_string(place) + " has no id in its property \"" +
                                 property + "\", and others have; --id names another property");
    }
    const auto [earlier, is_new] = places.emplace(*id, place);
    if (!is_new) {
      throw InputError(file, "features " + std::to_string(earlier->second) + " and " +
                                 std::to_string(place) + " have the same " + property + " \"" +
                                 id->text() +
                                 "\"; --id names a property that differs from plot to plot");
    }
    ids.push_back(*id);
  }
  return ids;
}

}  // namespace

PlotMap read_plot_map(const fs::path& file, const std::string& crs,
                      const std::optional<std::string>& id_property) {
  PlacedPlots placed = read_plot_features(file, crs);
  PlotMap map{.plots = std::move(placed.plots), .from_degrees = placed.from_degrees};
  if (map.plots.empty()) throw InputError(file, "has no plots");
  if (const auto property = id_property_of(file, map.plots, id_property)) {
    map.id_property = *property;
    map.ids = ids_of(file, map.plots, *property);
  } else {
    for (std::size_t i = 0; i < map.plots.size(); ++i) map.ids.emplace_back(i + 1);
  }
  return map;
}

void take_names(const PlotMap& map, Estimate& estimate) {
  check(map.plots.size() == estimate.plots.size(), "an estimate of other plots than the map's");
  estimate.id_property = map.id_property;
  for (std::size_t i = 0; i < map.plots.size(); ++i) {
    const PlotEstimate named = plot_of(map.plots[i], i + 1);
    estimate.plots[i].id = map.ids[i];
    estimate.plots[i].row = named.row;
    estimate.plots[i].column = named.column;
    estimate.plots[i].attributes = given_attributes(map.plots[i]);
  }
  estimate.diagnostics["boxes"] = {
      {"plots", map.plots.size()}, {"id", map.id_property}, {"from_degrees", map.from_degrees}};
}

}  // namespace plotscan::estimate
