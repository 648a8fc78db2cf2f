// SPDX-License-Identifier: Apache-2.0
#include "report/internal/pack_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "report/decimals.h"
#include "report/internal/packed.h"

namespace plotscan::report {
namespace {

using nlohmann::json;
using Indices = std::vector<std::uint32_t>;

constexpr std::size_t kTilePoints = 32'768;
constexpr std::size_t kCoarsest = 256;  // most points in the first level
constexpr float kSmallestTile_m = 0.25F;

struct Tile {
  std::span<std::uint32_t> points;  // indices into the cloud
  Eigen::AlignedBox3f bounds = {};
  double step_m = kStep_m;
  Bytes data = {};
};

struct TimeRange {
  float first_s = 0, last_s = 0;
};

// A square of the plane, and the points in it.
struct Square {
  Eigen::Vector2f low;
  float side_m;
  std::span<std::uint32_t> points;
};

void divide(const std::vector<ShownPoint>& points, const Square& square, std::vector<Tile>& tiles) {
  if (square.points.empty()) return;
  if (square.points.size() <= kTilePoints || square.side_m <= kSmallestTile_m) {
    tiles.push_back({.points = square.points});
    return;
  }
  const float half_m = square.side_m / 2;
  const Eigen::Vector2f middle = square.low + Eigen::Vector2f::Constant(half_m);
  const auto part = [](std::span<std::uint32_t> all, const auto& in_first) {
    const auto middle_of = std::stable_partition(all.begin(), all.end(), in_first);
    const auto count = static_cast<std::size_t>(middle_of - all.begin());
    return std::array{all.first(count), all.subspan(count)};
  };
  const auto rows = part(square.points, [&](auto i) { return points[i].place.y() < middle.y(); });
  for (int row = 0; row < 2; ++row) {
    const auto columns = part(rows[row], [&](auto i) { return points[i].place.x() < middle.x(); });
    for (int column = 0; column < 2; ++column) {
      const Eigen::Vector2f low = square.low + half_m * Eigen::Vector2f(static_cast<float>(column),
                                                                        static_cast<float>(row));
      divide(points, {low, half_m, columns[column]}, tiles);
    }
  }
}

// Spreads the number's bits: they become every third bit of the result, from the lowest on.
std::uint64_t spread(std::uint16_t number) {
  std::uint64_t bits = number;
  bits = (bits | bits << 16) & 0x0000FF0000FFULL;
  bits = (bits | bits << 8) & 0x00F00F00F00FULL;
  bits = (bits | bits << 4) & 0x0C30C30C30C3ULL;
  bits = (bits | bits << 2) & 0x249249249249ULL;
  return bits;
}

using Places = std::array<std::vector<std::uint16_t>, 3>;

// The positions of the tile's points on each axis, in steps from its low corner.
Places places_of(const std::vector<ShownPoint>& points, Tile& tile) {
  for (const std::uint32_t i : tile.points) tile.bounds.extend(points[i].place);
  const double size_m = tile.bounds.sizes().maxCoeff();
  while (size_m / tile.step_m > 65534) tile.step_m *= 2;
  Places places;
  for (int axis = 0; axis < 3; ++axis) {
    places[axis].reserve(tile.points.size());
    for (const std::uint32_t i : tile.points) {
      const double offset_m = static_cast<double>(points[i].place[axis]) - tile.bounds.min()[axis];
      places[axis].push_back(static_cast<std::uint16_t>(std::lround(offset_m / tile.step_m)));
    }
  }
  return places;
}

// The order in which a tile is drawn: places in the tile's list, level after level.
Indices drawing_order(const Places& places) {
  const std::size_t n = places[0].size();
  std::vector<std::uint64_t> codes(n);
  for (std::size_t i = 0; i < n; ++i)
    codes[i] = spread(places[0][i]) | spread(places[1][i]) << 1 | spread(places[2][i]) << 2;
  Indices sorted(n);
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::sort(sorted, [&](auto a, auto b) {
    return codes[a] < codes[b] || (codes[a] == codes[b] && a < b);
  });
  Indices order;
  order.reserve(n);
  const int levels = tile_levels(n);
  const std::size_t stride = std::size_t{1} << levels;
  for (std::size_t i = 0; i < n; i += stride) order.push_back(sorted[i]);
  for (std::size_t step = stride / 2; step >= 1; step /= 2)
    for (std::size_t i = step; i < n; i += 2 * step) order.push_back(sorted[i]);
  return order;
}

TimeRange times_of(const ShownCloud& cloud) {
  if (!cloud.has_time || cloud.points.empty()) return {};
  const auto [first, last] = std::ranges::minmax_element(cloud.points, {}, &ShownPoint::time_s);
  return {first->time_s, last->time_s};
}

void append_attributes(const ShownCloud& cloud, const TimeRange& times, const Tile& tile,
                       const Indices& order, Bytes& bytes) {
  const auto append = [&](const auto& byte_of) {
    for (const std::uint32_t i : order)
      bytes.push_back(static_cast<std::uint8_t>(byte_of(cloud.points[tile.points[i]])));
  };
  const float duration_s = std::max(times.last_s - times.first_s, 1e-6F);
  if (cloud.has_class) append([](const ShownPoint& point) { return point.label; });
  if (cloud.has_plot) {
    const auto plot = [](const ShownPoint& point) { return std::min(point.plot, 65535U); };
    append([&](const ShownPoint& point) { return plot(point) & 255; });
    append([&](const ShownPoint& point) { return plot(point) >> 8; });
  }
  if (cloud.has_intensity) {
    append([](const ShownPoint& point) {
      return std::lround(std::clamp(point.intensity, 0.0F, 255.0F));
    });
  }
  if (cloud.has_time) {
    append([&](const ShownPoint& point) {
      return std::lround(255 * (point.time_s - times.first_s) / duration_s);
    });
  }
}

void pack(const ShownCloud& cloud, const TimeRange& times, Tile& tile) {
  const Places places = places_of(cloud.points, tile);
  const Indices order = drawing_order(places);
  Bytes bytes;
  std::vector<std::uint16_t> ordered(order.size());
  for (const auto& axis : places) {
    std::ranges::transform(order, ordered.begin(), [&](auto i) { return axis[i]; });
    append_differences(bytes, ordered);
  }
  append_attributes(cloud, times, tile, order, bytes);
  tile.data = deflated(bytes);
}

std::vector<Tile> tiles_of(const ShownCloud& cloud, Indices& indices) {
  indices.resize(cloud.points.size());
  std::iota(indices.begin(), indices.end(), 0);
  Eigen::AlignedBox2f bounds;
  for (const ShownPoint& point : cloud.points) bounds.extend(point.place.head<2>());
  std::vector<Tile> tiles;
  if (cloud.points.empty()) return tiles;
  // A little larger than the bounds, so that points on the far edges lie inside.
  const float side_m = bounds.sizes().maxCoeff() * 1.0001F + 0.001F;
  divide(cloud.points, {bounds.min(), side_m, indices}, tiles);
  return tiles;
}

json corner(const Eigen::Vector3f& place) {
  return {decimals(place.x(), 4), decimals(place.y(), 4), decimals(place.z(), 4)};
}

}  // namespace

int tile_levels(std::size_t n) {
  int levels = 0;
  while ((n >> levels) > kCoarsest) ++levels;
  return levels;
}

json packed_cloud(const ShownCloud& cloud) {
  const TimeRange times = times_of(cloud);
  Indices indices;
  std::vector<Tile> tiles = tiles_of(cloud, indices);
  tbb::parallel_for(std::size_t{0}, tiles.size(),
                    [&](std::size_t i) { pack(cloud, times, tiles[i]); });
  json listed = json::array();
  Bytes data;
  for (const Tile& tile : tiles) {
    listed.push_back({{"n", tile.points.size()},
                      {"at", data.size()},
                      {"bytes", tile.data.size()},
                      {"low", corner(tile.bounds.min())},
                      {"high", corner(tile.bounds.max())},
                      {"step", tile.step_m}});
    data.insert(data.end(), tile.data.begin(), tile.data.end());
    data.resize((data.size() + 2) / 3 * 3);
  }
  json has = json::array();
  if (cloud.has_class) has.push_back("class");
  if (cloud.has_plot) has.push_back("plot");
  if (cloud.has_intensity) has.push_back("intensity");
  if (cloud.has_time) has.push_back("time");
  return {{"read", cloud.read},
          {"shown", cloud.points.size()},
          {"origin", {cloud.origin.x(), cloud.origin.y(), cloud.origin.z()}},
          {"time",
           {decimals(cloud.time_origin_s + times.first_s, 3),
            decimals(cloud.time_origin_s + times.last_s, 3)}},
          {"has", has},
          {"tiles", listed},
          {"data", json::binary(std::move(data))}};
}

}  // namespace plotscan::report
