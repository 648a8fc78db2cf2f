// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/change_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/core.h>

#include "core/text.h"
#include "farmbench/figure_text.h"
#include "farmbench/internal/method_rows.h"

namespace plotscan::farmbench {
namespace {

constexpr double kLegendLine = 18;  // height of one row of the legend, pixels
constexpr double kMarkStep = 9;     // from method to method, pixels
constexpr double kCaseGap = 12;     // from case to case
// The axis goes no further: a case that changes everything would hide all others. Marks beyond it
// stand at its end with their value.
constexpr double kFurthest_cm = 15;

// Okabe and Ito's colours, told apart by colour-blind readers.
constexpr std::array<const char*, 8> kColours = {"#56b4e9", "#e69f00", "#0072b2", "#009e73",
                                                 "#cc79a7", "#d55e00", "#555555", "#f0e442"};

// Chart coordinates, pixels.
struct Frame {
  double left, top, width, height;
  double bottom() const { return top + height; }
};

// The place among the colours of each row that the suite's methods make, the same in every chart. A
// method's heights that are named after truths share one: each stands beside its own truth alone.
using Palette = std::map<std::string, std::size_t>;

Palette palette_of(const SuiteResult& result) {
  Palette place_of_row;
  std::set<std::string> truths;
  for (const FarmResult& farm : result.farms) {
    for (const MethodResult& run : farm.methods) truths.merge(score::true_heights(run.score));
  }
  std::size_t places = 0;
  for (const std::string& name : result.methods) {
    std::optional<std::size_t> shared;
    for (const MethodHeight& height : heights_of(result, name)) {
      if (!truths.contains(score::named_truth(height.height))) {
        place_of_row[height.row] = places++;
        continue;
      }
      if (!shared) shared = places++;
      place_of_row[height.row] = *shared;
    }
  }
  return place_of_row;
}

const char* colour(const Palette& palette, const std::string& row) {
  return kColours[palette.at(row) % kColours.size()];
}

// Text as it may stand in HTML and SVG.
std::string escaped(const std::string& text) {
  return with_escapes(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>", x1, y1,
                     x2, y2, style);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">", x, y, anchor) +
         escaped(text) + "</text>";
}

std::string svg(double width, double height, const std::string& content) {
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" ",
                     width, height, width, height) +
         "xmlns=\"http://www.w3.org/2000/svg\" font-family=\"system-ui, sans-serif\" "
         "font-size=\"12\" fill=\"#222\" style=\"background:#fff\">" +
         content + "</svg>\n";
}

// From low to high in at most six steps of 1, 2 or 5 times a power of ten.
std::vector<double> ticks(double low, double high) {
  constexpr double kSteps = 6;
  const double power = std::pow(10, std::floor(std::log10((high - low) / kSteps)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if ((high - low) / (factor * power) <= kSteps) step = factor * power;
  }
  const int count = static_cast<int>((high - low) / step + 1e-6);
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(low + i * step);
  return values;
}

std::string legend(const Palette& palette, const std::vector<std::string>& rows, double x,
                   double y) {
  std::string text;
  for (const std::string& row : rows) {
    text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"11\" height=\"11\" fill=\"{}\"/>",
                        x, y - 10, colour(palette, row)) +
            label(x + 17, y, "start", row);
    y += kLegendLine;
  }
  return text;
}

// Changes of RMSE that the chart shows, cm.
struct ChangeRange {
  double low = 0;
  double high = 0.1;
};

ChangeRange range_of(const std::vector<TableRow>& rows) {
  ChangeRange range;
  for (const TableRow& row : rows) {
    for (const double value_m :
         {row.rmse_change_m, row.rmse_change_95_m.low, row.rmse_change_95_m.high}) {
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
  if (!std::isnan(row.rmse_change_95_m.low))
    text += line(place(row.rmse_change_95_m.low), y, place(row.rmse_change_95_m.high), y,
                 style.c_str());
  if (100 * row.rmse_change_m > range.high)
    text += label(place(row.rmse_change_m) + 6, y + 4, "start", centimetres(row.rmse_change_m));
  return text +
         fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"{}\">",
                     place(row.rmse_change_m), y, colour) +
         "<title>" +
         escaped(row.method + ", " + row.case_name + ": " +
                 with_interval(row.rmse_change_m, row.rmse_change_95_m) + " cm") +
         "</title></circle>";
}

}  // namespace

std::string change_chart(const SuiteResult& result, const std::vector<TableRow>& rows) {
  const Palette palette = palette_of(result);
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
          content += mark(row, range, zero_x, px_per_cm, y, colour(palette, method));
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
