// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/core.h>

#include "farmbench/internal/method_rows.h"
#include "score/height_score.h"

namespace plotscan::farmbench {
namespace {

// Okabe and Ito's colours, told apart by colour-blind readers.
constexpr std::array<const char*, 8> kColours = {"#56b4e9", "#e69f00", "#0072b2", "#009e73",
                                                 "#cc79a7", "#d55e00", "#555555", "#f0e442"};

}  // namespace

Palette::Palette(const SuiteResult& result) {
  std::set<std::string> truths;
  for (const FarmResult& farm : result.farms) {
    for (const MethodResult& run : farm.methods) truths.merge(score::true_heights(run.score));
  }
  std::size_t places = 0;
  for (const std::string& name : result.methods) {
    std::optional<std::size_t> shared;
    for (const MethodHeight& height : heights_of(result, name)) {
      if (!truths.contains(score::named_truth(height.height))) {
        place_of_row_[height.row] = places++;
        continue;
      }
      if (!shared) shared = places++;
      place_of_row_[height.row] = *shared;
    }
  }
}

const char* Palette::colour(const std::string& row) const {
  return kColours[place_of_row_.at(row) % kColours.size()];
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : text) {
    const auto entity = entities.find(c);
    result += entity == entities.end() ? std::string(1, c) : entity->second;
  }
  return result;
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
                        x, y - 10, palette.colour(row)) +
            label(x + 17, y, "start", row);
    y += kLegendLine;
  }
  return text;
}

}  // namespace plotscan::farmbench
