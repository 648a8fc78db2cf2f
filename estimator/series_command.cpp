// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>

#include <fmt/core.h>

#include "commands.h"
#include "series/run.h"

namespace plotscan {
namespace {

struct SeriesArguments {
  series::RunOptions options;
  std::string join;
};

void say_dates(const Program& program, const series::Series& joined, const std::string& height) {
  std::string earlier;
  for (const series::DateSummary& date : series::summary_of(joined, height)) {
    std::string growth;
    if (date.grown > 0) {
      const auto days = series::days_between(earlier, date.date);
      growth = fmt::format(", {:+.3f} m", date.growth_m) +
               (days ? fmt::format(" in {} days", *days) : "") + " (median)";
    }
    program.say("{:10} {} plots, {} median {:.3f} m{}", date.date, date.plots, height,
                date.median_m, growth);
    earlier = date.date;
  }
}

void make_series(const Program& program, const SeriesArguments& arguments) {
  series::RunOptions options = arguments.options;
  if (!arguments.join.empty())
    options.join = arguments.join == "ids" ? series::JoinBy::ids : series::JoinBy::places;
  const series::Series joined = series::run(options);
  program.say("joined     {} plots by {}", joined.plots.size(),
              joined.joined_by == series::JoinBy::ids ? "id" : "place");
  say_dates(program, joined, options.height);
  for (const std::string& note : joined.notes) program.announce("note: " + note);
  program.say("written to " + options.output.string());
  program.result(series::to_json(joined, options.height));
}

}  // namespace

void declare_series(Program& program) {
  const auto shared = std::make_shared<SeriesArguments>();
  series::RunOptions& options = shared->options;
  CLI::App& series =
      program.command("series", "Join estimates of one field at several dates into one table.",
                      [&program, shared] { make_series(program, *shared); });
  series
      .add_option("EST", options.estimates,
                  "two or more estimate folders, or GeoJSON files of plots with numbers "
                  "height_<name>_m, metres, of one field")
      ->required();
  series.add_option("-o,--output", options.output, "folder to write")->required();
  series
      .add_option("--dates", options.dates,
                  "the date of each estimate, in their order, separated by commas: YYYY-MM-DD, or "
                  "any other name (default: the day of the flight where the cloud's times tell it, "
                  "else the date in the folder's name, else this name)")
      ->delimiter(',')
      ->allow_extra_args(false);
  series.add_option("--height", options.height,
                    "height of the table by date, of the map and of the growth");
  series
      .add_option("--join", shared->join,
                  "ids: plots with the same id are one; places: those whose centres lie within "
                  "half a plot, in one coordinate system (default: ids where all estimates have "
                  "those of a map or a table, else places)")
      ->check(CLI::IsMember({"ids", "places"}));
  series.add_flag("--force", options.replace, "replace an existing folder");
}

}  // namespace plotscan
