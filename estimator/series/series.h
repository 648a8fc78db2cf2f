// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimate/estimate.h"

namespace plotscan::series {

// The result of one flight over a field.
struct DatedEstimate {
  std::filesystem::path folder;  // as the user named it, for messages
  std::string date;              // "2026-06-01", or any other name of the flight
  // Whose plots have the ids of a map or a table (--boxes, --plot-names); else they are numbered
  // where they were found.
  bool ids_are_given = false;
  estimate::Estimate estimate;  // its plots with their own attributes
};

// How the plots of different dates are recognised as the same.
enum class JoinBy {
  ids,    // they have the same id
  places  // the centre of one lies in the other's box
};

// One plot through the season.
struct PlotSeries {
  // Id, place in the grid, box and attributes: those of the first result that has it.
  estimate::PlotEstimate plot;
  std::vector<std::optional<estimate::PlotEstimate>> at = {};  // one for each date
};

// How much a height of a plot changed between two dates.
struct Growth {
  std::size_t from = 0, to = 0;  // indices of the dates
  double growth_m = 0;
  // Root of the sum of both squared standard errors, as if the errors of two dates had nothing in
  // common; NaN where one of them states none.
  double standard_error_m = 0;
  std::vector<std::string> flags = {};  // of either date, that concern the height
};

struct Series {
  std::vector<std::string> dates = {};
  JoinBy joined_by = JoinBy::ids;
  std::string id_property = {};  // and the system of the boxes: of the result that names the plots
  std::string crs = {};
  std::optional<CoordinateUnits> units = {};
  std::vector<PlotSeries> plots = {};
  std::vector<std::string> notes = {};  // what is odd about it, a sentence each
};

// Joins the plots of at least two results, in the order of their dates where all are dates, else in
// the given one. They are joined as asked; else by ids where all of these are given, else by
// places. The plots have the names of the first result whose ids are given, else of the first. One
// that only a later result has follows them; where its number is another's, it is called
// <number>@<date>. Throws InputError where two results have the same date; where plots are joined
// by places and the results are in different coordinate systems; and where a result shares no plot
// with the others.
Series joined_series(std::vector<DatedEstimate> results, std::optional<JoinBy> by = std::nullopt);

// The changes of a height from each date at which the plot has it to the next such.
std::vector<Growth> growth_of(const PlotSeries& plot, const std::string& height);

// The days between two dates; absent where one of them is no date (YYYY-MM-DD).
std::optional<int> days_between(const std::string& from, const std::string& to);

}  // namespace plotscan::series
