// SPDX-License-Identifier: Apache-2.0
#include "series/series.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/core.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "core/text.h"
#include "methods/flags.h"
#include "series/internal/dates.h"
#include "series/internal/join.h"

namespace plotscan::series {
namespace {

using estimate::PlotEstimate;

void sort_by_date(std::vector<DatedEstimate>& results) {
  const auto is_day = [](const DatedEstimate& result) { return day_of(result.date).has_value(); };
  if (std::ranges::all_of(results, is_day))
    std::ranges::stable_sort(results, {}, &DatedEstimate::date);
}

void require_different_dates(const std::vector<DatedEstimate>& results) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (results[i].date == results[j].date)
        throw InputError(results[i].folder,
                         "and {} have the same date, {}; --dates gives each its own",
                         results[j].folder.string(), results[i].date);
    }
  }
}

std::string system_text(const std::string& crs) {
  return crs.empty() ? "coordinates of no known system" : in_quotes(crs);
}

void require_same_system(const DatedEstimate& first, const DatedEstimate& other) {
  if (first.estimate.crs == other.estimate.crs) return;
  throw InputError(other.folder,
                   "is in {}, {} in {}: plots are joined by place in one system only; state the "
                   "clouds' system by estimator run --crs, or give --join ids where ids are the "
                   "field's own",
                   system_text(other.estimate.crs), first.folder.string(),
                   system_text(first.estimate.crs));
}

[[noreturn]] void fail_apart(const Series& series, const DatedEstimate& other) {
  if (series.joined_by == JoinBy::ids)
    throw InputError(other.folder,
                     "has no plot id that an earlier result has; --join places joins by place");
  const auto text = [](const Eigen::AlignedBox2d& extent) {
    return fmt::format("x {:.1f} to {:.1f}, y {:.1f} to {:.1f}", extent.min().x(), extent.max().x(),
                       extent.min().y(), extent.max().y());
  };
  const auto box_of = [](const PlotSeries& plot) { return plot.plot.box; };
  throw InputError(other.folder,
                   "has no plot where another result has one: its plots lie within {}, those of "
                   "the others within {} (metres); is it another field, or in other coordinates?",
                   text(extent_of(other.estimate.plots, &PlotEstimate::box)),
                   text(extent_of(list_of(series.plots, box_of))));
}

// A new plot's number may be another's: plots that are found are counted anew at each date.
void give_own_id(PlotEstimate& plot, const std::vector<PlotSeries>& known,
                 const std::string& date) {
  const auto id_of = [](const PlotSeries& other) { return other.plot.id; };
  if (contains(known, plot.id, id_of)) plot.id = PlotId(plot.id.text() + "@" + date);
}

// Plots of the same id that lie apart, where both results are in one system.
void note_apart(const Series& series, const DatedEstimate& result, const Matches& matches,
                std::vector<std::string>& notes) {
  if (series.joined_by != JoinBy::ids || series.crs != result.estimate.crs) return;
  std::vector<PlotId> apart;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const PlotEstimate& plot = result.estimate.plots[i];
    if (matches[i] && !series.plots[*matches[i]].plot.box.contains(plot.box.center))
      apart.push_back(plot.id);
  }
  if (apart.empty()) return;
  notes.push_back(fmt::format(
      "{}: {} of {} plots lie more than half a plot from the others of their id, the first is {}; "
      "are the maps of one field, and in the same coordinates?",
      result.date, apart.size(), matches.size(), apart.front().text()));
}

void note_missing(const DatedEstimate& result, std::size_t found, std::size_t known,
                  std::vector<std::string>& notes) {
  const std::size_t fresh = result.estimate.plots.size() - found;
  if (found == known && fresh == 0) return;
  notes.push_back(fmt::format("{}: {} of the {} plots before it are missing, {} are new",
                              result.date, known - found, known, fresh));
}

void add(const DatedEstimate& result, std::size_t date, Series& series) {
  const std::vector<PlotEstimate>& plots = result.estimate.plots;
  const Matches matches = series.joined_by == JoinBy::ids ? matches_by_id(series.plots, plots)
                                                          : matches_by_place(series.plots, plots);
  const std::size_t known = series.plots.size();
  const auto found = static_cast<std::size_t>(
      std::ranges::count_if(matches, [](const auto& match) { return match.has_value(); }));
  if (known > 0 && found == 0) fail_apart(series, result);
  note_apart(series, result, matches, series.notes);
  if (known > 0) note_missing(result, found, known, series.notes);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    if (!matches[i]) {
      series.plots.push_back({.plot = plots[i]});
      PlotSeries& added = series.plots.back();
      added.at.resize(series.dates.size());
      if (known > 0)
        give_own_id(added.plot, {series.plots.begin(), series.plots.end() - 1}, result.date);
    }
    PlotSeries& plot = matches[i] ? series.plots[*matches[i]] : series.plots.back();
    plot.at[date] = plots[i];
  }
}

}  // namespace

Series joined_series(std::vector<DatedEstimate> results, std::optional<JoinBy> by) {
  check(results.size() >= 2, "a series has two results at least");
  sort_by_date(results);
  require_different_dates(results);
  Series series{.dates = list_of(results, &DatedEstimate::date)};
  const bool all_given = std::ranges::all_of(results, &DatedEstimate::ids_are_given);
  series.joined_by = by.value_or(all_given ? JoinBy::ids : JoinBy::places);
  std::vector<std::size_t> order(results.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return !results[i].ids_are_given; });
  const DatedEstimate& first = results[order.front()];
  series.id_property = first.estimate.id_property;
  series.crs = first.estimate.crs;
  series.units = first.estimate.units;
  for (const std::size_t i : order) {
    if (results[i].estimate.plots.empty()) throw InputError(results[i].folder, "has no plots");
    if (series.joined_by == JoinBy::places) require_same_system(first, results[i]);
    add(results[i], i, series);
  }
  return series;
}

std::vector<Growth> growth_of(const PlotSeries& plot, const std::string& height) {
  std::vector<Growth> growth;
  std::optional<std::size_t> from;
  for (std::size_t to = 0; to < plot.at.size(); ++to) {
    if (!plot.at[to] || !plot.at[to]->heights_m.contains(height)) continue;
    if (from) {
      const PlotEstimate& earlier = *plot.at[*from];
      const PlotEstimate& later = *plot.at[to];
      const auto error_m = [&](const PlotEstimate& at) {
        const auto found = at.errors.find(height);
        return found == at.errors.end() ? kNaN : found->second.standard_error_m;
      };
      growth.push_back({.from = *from,
                        .to = to,
                        .growth_m = later.heights_m.at(height) - earlier.heights_m.at(height),
                        .standard_error_m = std::hypot(error_m(earlier), error_m(later))});
      std::set<std::string> flags(earlier.flags.begin(), earlier.flags.end());
      flags.insert(later.flags.begin(), later.flags.end());
      growth.back().flags =
          those_of(flags, [&](const std::string& flag) { return methods::concerns(flag, height); });
    }
    from = to;
  }
  return growth;
}

}  // namespace plotscan::series
