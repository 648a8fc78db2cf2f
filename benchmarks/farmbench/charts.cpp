// SPDX-License-Identifier: Apache-2.0
#include "farmbench/charts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "farmbench/format.h"
#include "farmbench/methods.h"
#include "farmbench/svg.h"
#include "score/height_score.h"

namespace plotscan::farmbench {
namespace {

std::string bar(const Frame& frame, double x, double width, double px_per_cm, const TableRow& row,
                const char* colour) {
  const double height = 100 * row.rmse_m * px_per_cm;
  std::string text =
      formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\">", x,
                frame.bottom() - height, width, height, colour) +
      "<title>" +
      escaped(row.method + ", " + row.case_name + ": " +
              with_interval(row.rmse_m, row.rmse_low_m, row.rmse_high_m) + " cm") +
      "</title></rect>";
  if (!std::isnan(row.rmse_low_m)) {
    const double middle = x + width / 2;
    text += line(middle, frame.bottom() - 100 * row.rmse_low_m * px_per_cm, middle,
                 frame.bottom() - 100 * row.rmse_high_m * px_per_cm,
                 "stroke=\"#222\" stroke-width=\"1.5\"");
  }
  return text;
}

double highest_cm(const SuiteResult& result, const std::vector<TableRow>& rows) {
  double highest = 1;
  for (const TableRow& row : rows) {
    for (const double value_m : {row.rmse_m, row.rmse_high_m}) {
      if (!std::isnan(value_m)) highest = std::max(highest, 100 * value_m);
    }
  }
  for (const CaseInfo& info : result.cases)
    highest = std::max(highest, info.published_rmse_cm.value_or(0));
  return highest;
}

std::string horizontal_grid(const Frame& frame, double highest, double px_per_cm) {
  std::string text;
  for (const double tick : ticks(0, highest)) {
    const double y = frame.bottom() - tick * px_per_cm;
    text += line(frame.left, y, frame.left + frame.width, y, "stroke=\"#ddd\"") +
            label(frame.left - 6, y + 4, "end", formatted("%g", tick));
  }
  return text;
}

// One method of a height chart, and its plots.
struct HeightSeries {
  std::string row;
  score::HeightPairs pairs;
};

HeightSeries series_of(const SuiteResult& result, const std::string& case_name,
                       const std::string& truth, const Method& method, const MethodHeight& height) {
  HeightSeries series{.row = height.row, .pairs = {}};
  for (const FarmResult& farm : result.farms) {
    if (farm.case_name != case_name) continue;
    for (const MethodResult& run : farm.methods) {
      if (run.method != method.name) continue;
      score::append(series.pairs, score::height_pairs(run.score, height.height, truth));
    }
  }
  return series;
}

// What a height chart shows of the rows beside its truth: those with published figures, else the
// first; those named after it; and the last.
std::vector<HeightSeries> chosen_series(const SuiteResult& result, const std::string& case_name,
                                        const std::string& truth) {
  std::vector<HeightSeries> all;
  std::vector<std::string> shown;
  for (const std::string& name : result.methods) {
    const Method& method = method_named(name);
    const std::set<std::string> beside = score::heights_beside(truth, heights_of(method));
    for (const MethodHeight& height : method.heights) {
      if (!beside.contains(height.height)) continue;
      all.push_back(series_of(result, case_name, truth, method, height));
      if (score::named_truth(height.height) == truth) shown.push_back(height.row);
    }
  }
  shown.push_back(all.back().row);
  if (result.published) {
    shown.insert(shown.end(), result.published->methods.begin(), result.published->methods.end());
  } else {
    shown.push_back(all.front().row);
  }
  std::erase_if(all, [&](const HeightSeries& series) {
    return std::ranges::find(shown, series.row) == shown.end();
  });
  return all;
}

std::string dots(const Frame& frame, double low, double px_per_m, const HeightSeries& series,
                 const char* colour) {
  std::string text = formatted("<g fill=\"%s\" fill-opacity=\"0.55\">", colour);
  for (std::size_t i = 0; i < series.pairs.truths_m.size(); ++i) {
    text += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.2\"/>",
                      frame.left + (series.pairs.truths_m[i] - low) * px_per_m,
                      frame.bottom() - (series.pairs.estimates_m[i] - low) * px_per_m);
  }
  return text + "</g>";
}

struct HeightRange {
  double low = 0, high = 1;
};

HeightRange range_of(const std::vector<HeightSeries>& all) {
  std::vector<double> values;
  for (const HeightSeries& series : all) {
    values.insert(values.end(), series.pairs.truths_m.begin(), series.pairs.truths_m.end());
    values.insert(values.end(), series.pairs.estimates_m.begin(), series.pairs.estimates_m.end());
  }
  if (values.empty()) return {};
  return {std::floor(std::ranges::min(values) * 10) / 10,
          std::floor(std::ranges::max(values) * 10 + 1) / 10};
}

}  // namespace

std::string rmse_chart(const SuiteResult& result, const std::vector<TableRow>& rows) {
  const Palette palette(result);
  const Frame frame{.left = 40, .top = 24, .width = 660, .height = 240};
  const double highest = highest_cm(result, rows) * 1.05;
  const double px_per_cm = frame.height / highest;
  const double group = frame.width / static_cast<double>(result.cases.size());
  const std::vector<std::string> methods = methods_of(rows);
  const double width = 0.8 * group / static_cast<double>(methods.size());
  std::string content =
      label(frame.left - 30, 14, "start", "RMSE, cm") + horizontal_grid(frame, highest, px_per_cm);
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const CaseInfo& info = result.cases[i];
    const double left = frame.left + group * (static_cast<double>(i) + 0.1);
    double x = left;
    for (const TableRow& row : rows) {
      if (row.case_name != info.name) continue;
      if (!std::isnan(row.rmse_m)) {
        content += bar(frame, x, width * 0.9, px_per_cm, row, palette.colour(row.method));
      }
      x += width;
    }
    content += label(left + 0.4 * group, frame.bottom() + 18, "middle", info.name);
    if (!info.published_rmse_cm || !result.published) continue;
    const double y = frame.bottom() - *info.published_rmse_cm * px_per_cm;
    content +=
        line(left, y, left + 0.8 * group, y,
             "stroke=\"#b00\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"") +
        label(left + 0.8 * group + 3, y + 4, "start", formatted("%.1f", *info.published_rmse_cm));
  }
  double y = frame.bottom() + 42;
  content += legend(palette, methods, frame.left, y);
  y += kLegendLine * static_cast<double>(methods.size());
  if (result.published) {
    content += line(frame.left, y - 4, frame.left + 12, y - 4,
                    "stroke=\"#b00\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"") +
               label(frame.left + 17, y, "start", "published: " + result.published->source);
  }
  return svg(760, y + 10, content);
}

std::string height_chart(const SuiteResult& result, const std::string& case_name,
                         const std::string& truth) {
  const std::vector<HeightSeries> all = chosen_series(result, case_name, truth);
  const Palette palette(result);
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const HeightSeries& series : all) names.push_back(series.row);
  const Frame frame{.left = 40, .top = 28, .width = 250, .height = 250};
  const HeightRange range = range_of(all);
  const double px_per_m = frame.width / (range.high - range.low);
  std::string content = label(frame.left, 16, "start", case_name + ": estimate over truth, m");
  for (const double tick : ticks(range.low, range.high)) {
    const double offset = (tick - range.low) * px_per_m;
    const std::string text = formatted("%.2g", tick);
    content += line(frame.left, frame.bottom() - offset, frame.left + frame.width,
                    frame.bottom() - offset, "stroke=\"#eee\"") +
               label(frame.left - 5, frame.bottom() - offset + 4, "end", text) +
               label(frame.left + offset, frame.bottom() + 16, "middle", text);
  }
  content += line(frame.left, frame.bottom(), frame.left + frame.width, frame.top,
                  "stroke=\"#999\" stroke-dasharray=\"4 3\"");
  for (const HeightSeries& series : all)
    content += dots(frame, range.low, px_per_m, series, palette.colour(series.row));
  content += legend(palette, names, frame.left, frame.bottom() + 38);
  return svg(310, frame.bottom() + 38 + kLegendLine * static_cast<double>(names.size()), content);
}

}  // namespace plotscan::farmbench
