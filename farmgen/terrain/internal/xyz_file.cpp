// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/list_of.h"
#include "core/parse.h"
#include "core/text.h"
#include "terrain/internal/base_terrains.h"
#include "terrain/internal/refine.h"

namespace plotscan::terrain {
namespace {

constexpr std::string_view kSeparators = " \t\r,;";

struct PointOnLine {
  Eigen::Vector3d point;
  std::size_t line;
};

double number_of(std::string_view field, const std::filesystem::path& path, std::size_t line) {
  const auto value = parsed<double>(field);
  if (!value) throw InputError(path, line, "\"{}\" is not a number; x y z are expected", field);
  if (!std::isfinite(*value)) throw InputError(path, line, "\"{}\" is not finite", field);
  return *value;
}

// The three numbers of a line; false when it holds nothing.
bool parse(std::string_view text, const std::filesystem::path& path, PointOnLine& parsed) {
  text = text.substr(0, text.find('#'));
  Eigen::Index fields = 0;
  while (true) {
    const auto begin = text.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) break;
    text.remove_prefix(begin);
    const std::string_view field = text.substr(0, text.find_first_of(kSeparators));
    text.remove_prefix(field.size());
    if (fields == 3) throw InputError(path, parsed.line, "has more than three numbers");
    parsed.point[fields++] = number_of(field, path, parsed.line);
  }
  if (fields == 1 || fields == 2)
    throw InputError(path, parsed.line, "has {} of the three numbers x y z", fields);
  return fields == 3;
}

void require_different_places(const std::filesystem::path& path, std::vector<PointOnLine> points) {
  const auto key = [](const PointOnLine& each) {
    return std::array{each.point.x(), each.point.y(), static_cast<double>(each.line)};
  };
  std::sort(points.begin(), points.end(),
            [&](const PointOnLine& a, const PointOnLine& b) { return key(a) < key(b); });
  const auto twice = std::adjacent_find(
      points.begin(), points.end(), [](const PointOnLine& a, const PointOnLine& b) {
        return a.point.x() == b.point.x() && a.point.y() == b.point.y();
      });
  if (twice == points.end()) return;
  throw InputError(path, (twice + 1)->line, "has the x and y of line {} again", twice->line);
}

}  // namespace

std::vector<Eigen::Vector3d> read_xyz(const std::filesystem::path& path) {
  const std::string whole = read_text(path);
  const std::string_view text = without_byte_order_mark(whole);
  std::vector<PointOnLine> parsed;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    PointOnLine next{.point = Eigen::Vector3d::Zero(), .line = ++line};
    if (parse(text.substr(begin, end - begin), path, next)) parsed.push_back(next);
    if (parsed.size() > kMostTerrainVertices) {
      throw InputError(path, line, "is point {}; at most {} are allowed", parsed.size(),
                       kMostTerrainVertices);
    }
    begin = end + 1;
  }
  if (parsed.size() < 3)
    throw InputError(path, "has {} points; a terrain has 3 or more", parsed.size());
  require_different_places(path, parsed);
  return list_of(parsed, &PointOnLine::point);
}

}  // namespace plotscan::terrain
