// SPDX-License-Identifier: Apache-2.0
#include "series/internal/series_files.h"

#include <cmath>

#include "core/csv.h"
#include "core/list_of.h"
#include "core/plot_features.h"
#include "core/statistics.h"
#include "core/text.h"
#include "core/text_file.h"
#include "estimate/height_properties.h"
#include "estimate/plot_tables.h"

namespace plotscan::series {
namespace fs = std::filesystem;
namespace {

using estimate::PlotEstimate;

std::vector<PlotEstimate> plots_of(const Series& series) {
  return list_of(series.plots, &PlotSeries::plot);
}

// A line for each plot and date, under the names of the series.
void write_long(const fs::path& path, const Series& series) {
  std::vector<estimate::DatedPlot> lines;
  for (std::size_t date = 0; date < series.dates.size(); ++date) {
    for (const PlotSeries& plot : series.plots) {
      if (!plot.at[date]) continue;
      PlotEstimate line = *plot.at[date];
      line.id = plot.plot.id;
      line.trial = plot.plot.trial;
      line.row = plot.plot.row;
      line.column = plot.plot.column;
      lines.push_back({series.dates[date], std::move(line)});
    }
  }
  estimate::write_dated(path, lines);
}

double height_at(const std::optional<PlotEstimate>& plot, const std::string& height) {
  if (!plot) return kNaN;
  const auto found = plot->heights_m.find(height);
  return found == plot->heights_m.end() ? kNaN : found->second;
}

// "canopy_p95_m_2026-06-01" for each date, and the height of each plot then.
std::vector<estimate::NumberColumn> columns_by_date(const Series& series,
                                                    const std::string& height) {
  std::vector<estimate::NumberColumn> columns;
  for (std::size_t date = 0; date < series.dates.size(); ++date) {
    columns.push_back({.name = estimate::property_of(height) + "_" + series.dates[date],
                       .values = list_of(series.plots, [&](const PlotSeries& plot) {
                         return height_at(plot.at[date], height);
                       })});
  }
  return columns;
}

void write_map(const fs::path& path, const Series& series,
               const std::vector<estimate::NumberColumn>& columns) {
  std::vector<PlotFeature> features;
  for (const PlotSeries& plot : series.plots) {
    PlotFeature feature{
        .box = plot.plot.box, .properties = plot.plot.attributes, .id = plot.plot.id};
    feature.properties[series.id_property] = plot.plot.id;
    for (const estimate::NumberColumn& column : columns) {
      const double height_m = column.values[features.size()];
      if (!std::isnan(height_m)) feature.properties[column.name] = height_m;
    }
    features.push_back(feature);
  }
  write_plot_features(path, features, series.crs, series.units);
}

std::string text_of(double value) { return std::isnan(value) ? "" : format_number(value); }

void write_growth(const fs::path& path, const Series& series, const std::string& height) {
  TextFile out(path);
  out << "plot_id,from,to,days,growth_m,se_growth_m,growth_cm_per_day,flags\n";
  for (const PlotSeries& plot : series.plots) {
    for (const Growth& growth : growth_of(plot, height)) {
      const std::string& from = series.dates[growth.from];
      const std::string& to = series.dates[growth.to];
      const std::optional<int> days = days_between(from, to);
      out << csv_field(plot.plot.id.text()) << "," << csv_field(from) << "," << csv_field(to) << ","
          << (days ? std::to_string(*days) : "") << "," << growth.growth_m << ","
          << text_of(growth.standard_error_m) << ","
          << (days ? format_number(100 * growth.growth_m / *days) : "") << ","
          << csv_field(joined(growth.flags, "; ")) << "\n";
    }
  }
  out.close();
}

}  // namespace

void write_series(const fs::path& folder, const Series& series, const std::string& height) {
  write_long(folder / "series.csv", series);
  const std::vector<estimate::NumberColumn> columns = columns_by_date(series, height);
  estimate::write_numbers(folder / "by_date.csv", plots_of(series), columns);
  write_map(folder / "by_date.geojson", series, columns);
  write_growth(folder / "growth.csv", series, height);
}

}  // namespace plotscan::series
