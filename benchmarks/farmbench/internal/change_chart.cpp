// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/change_chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "farmbench/format.h"
#include "farmbench/internal/svg.h"

namespace plotscan::farmbench {
namespace {

constexpr double kMarkStep = 9;  // from method to method, pixels
constexpr double kCaseGap = 12;  // from case to case
// The axis goes no further: a case that changes everything would hide all others. Marks beyond it
// stand at its end with their value.
constexpr double kFurthest_cm = 15;

// Changes of RMSE that the chart shows, cm.
struct ChangeRange {
  double low = 0;
  double high = 0.1;
};

ChangeRange range_of(const std::vector<TableRow>& rows) {
  ChangeRange range;
  for (const TableRow& row : rows) {
    for (const double value_m :
         {row.rmse_change_m, row.rmse_change_low_m, row.rmse_change_high_m}) {
      if (std::isnan(value_m)) continue;
      range.low = std::min(range.low, 100 * value_m);
      range.high = std::max(range.high, 100 * value_m);
    }
  }
  return {std::max(std::floor(range.low), -kFurthest_cm),
          std::min(std::ceil(range.high), kFurthest_cm)};
}

std::string mark(const TableRow& row, const ChangeRange& range, double zero_x, double px_per_cm,
                 double y, const char* colour) {
  const auto place = [&](double value_m) {
    return zero_x + std::clamp(100 * value_m, range.low, range.high) * px_per_cm;
  };
  const std::string style = fmt::format("stroke=\"{}\" stroke-width=\"2\"", colour);
  std::string text;
  if (!std::isnan(row.rmse_change_low_m))
    text += line(place(row.rmse_change_low_m), y, place(row.rmse_change_high_m), y, style.c_str());
  if (100 * row.rmse_change_m > range.high)
    text += label(place(row.rmse_change_m) + 6, y + 4, "start", centimetres(row.rmse_change_m));
  return text +
         fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"{}\">",
                     place(row.rmse_change_m), y, colour) +
         "<title>" +
         escaped(row.method + ", " + row.case_name + ": " +
                 with_interval(row.rmse_change_m, row.rmse_change_low_m, row.rmse_change_high_m) +
                 " cm") +
         "</title></circle>";
}

}  // namespace

std::string change_chart(const SuiteResult& result, const std::vector<TableRow>& rows) {
  const Palette palette(result);
  const std::vector<std::string> methods = methods_of(rows);
  const double case_height = kMarkStep * static_cast<double>(methods.size()) + kCaseGap;
  const Frame frame{.left = 130,
                    .top = 30,
                    .width = 600,
                    .height = case_height * static_cast<double>(result.cases.size() - 1)};
  const ChangeRange range = range_of(rows);
  const double px_per_cm = frame.width / (range.high - range.low);
  const double zero_x = frame.left - range.low * px_per_cm;
  std::string content =
      label(frame.left, 16, "start", "change of RMSE against \"" + *result.baseline + "\", cm");
  for (const double tick : ticks(range.low, range.high)) {
    const double x = zero_x + tick * px_per_cm;
    content += line(x, frame.top, x, frame.bottom(), "stroke=\"#ddd\"") +
               label(x, frame.bottom() + 16, "middle", fmt::format("{:g}", tick));
  }
  content += line(zero_x, frame.top, zero_x, frame.bottom(), "stroke=\"#222\"");
  double top = frame.top;
  for (const CaseInfo& info : result.cases) {
    if (info.name == *result.baseline) continue;
    content += label(frame.left - 8, top + case_height / 2 + 4, "end", info.name) +
               line(frame.left, top + case_height, frame.left + frame.width, top + case_height,
                    "stroke=\"#eee\"");
    double y = top + kCaseGap / 2 + kMarkStep / 2;
    for (const std::string& method : methods) {
      for (const TableRow& row : rows) {
        if (row.case_name != info.name || row.method != method) continue;
        if (!std::isnan(row.rmse_change_m))
          content += mark(row, range, zero_x, px_per_cm, y, palette.colour(method));
      }
      y += kMarkStep;
    }
    top += case_height;
  }
  const double below = frame.bottom() + 40;
  content += legend(palette, methods, frame.left, below);
  return svg(800, below + kLegendLine * static_cast<double>(methods.size()), content);
}

}  // namespace plotscan::farmbench
