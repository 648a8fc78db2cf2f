// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the charts: what they draw with.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// Chart coordinates, pixels.
struct Frame {
  double left, top, width, height;
  double bottom() const { return top + height; }
};

// The colour of each row that the suite's methods make, the same in every chart. A method's heights
// that are named after truths share one: each stands beside its own truth alone.
class Palette {
 public:
  explicit Palette(const SuiteResult& result);
  const char* colour(const std::string& row) const;

 private:
  std::map<std::string, std::size_t> place_of_row_;
};

// Text as it may stand in HTML and SVG.
std::string escaped(const std::string& text);

std::string line(double x1, double y1, double x2, double y2, const char* style);
std::string label(double x, double y, const char* anchor, const std::string& text);
std::string svg(double width, double height, const std::string& content);

inline constexpr double kLegendLine = 18;  // height of one row of a legend
std::string legend(const Palette& palette, const std::vector<std::string>& rows, double x,
                   double y);

// From low to high in at most six steps of 1, 2 or 5 times a power of ten.
std::vector<double> ticks(double low, double high);

}  // namespace plotscan::farmbench
