// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <zlib.h>

// A reader of what report/ packs, written from docs/report-format.md.
namespace plotscan::testing {

inline std::vector<std::uint8_t> inflated(const std::uint8_t* bytes, std::size_t count,
                                          std::size_t size) {
  std::vector<std::uint8_t> out(size + 1);
  uLongf written = out.size();
  if (uncompress(out.data(), &written, bytes, count) != Z_OK || written != size)
    throw std::runtime_error("not a zlib stream of " + std::to_string(size) + " bytes");
  out.resize(size);
  return out;
}

// n numbers whose low bytes begin at `at`, their high bytes n later.
inline std::vector<std::uint16_t> numbers(const std::vector<std::uint8_t>& bytes, std::size_t at,
                                          std::size_t n) {
  std::vector<std::uint16_t> result;
  int last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int folded = bytes.at(at + i) + 256 * bytes.at(at + n + i);
    const int difference = folded % 2 == 0 ? folded / 2 : -(folded + 1) / 2;
    last = (last + difference + 65536) % 65536;
    result.push_back(static_cast<std::uint16_t>(last));
  }
  return result;
}

struct Point {
  double x = 0, y = 0, z = 0;
  int label = 0, plot = 0, intensity = 0, time = 0;
};

// A tile's points in drawing order; a cloud without a field leaves it 0.
inline std::vector<Point> tile_points(const nlohmann::json& cloud, const nlohmann::json& tile) {
  const std::vector<std::uint8_t>& data = cloud.at("data").get_binary();
  const std::size_t n = tile.at("n");
  std::size_t bytes_a_point = 6;
  const auto has = [&](const char* field) {
    for (const auto& name : cloud.at("has"))
      if (name == field) return true;
    return false;
  };
  bytes_a_point += (has("class") ? 1U : 0U) + (has("plot") ? 2U : 0U) +
                   (has("intensity") ? 1U : 0U) + (has("time") ? 1U : 0U);
  const auto bytes = inflated(data.data() + tile.at("at").get<std::size_t>(),
                              tile.at("bytes").get<std::size_t>(), n * bytes_a_point);
  std::vector<Point> points(n);
  const auto x = numbers(bytes, 0, n), y = numbers(bytes, 2 * n, n), z = numbers(bytes, 4 * n, n);
  const double step = tile.at("step");
  for (std::size_t i = 0; i < n; ++i) {
    points[i].x = tile.at("low").at(0).get<double>() + step * x[i];
    points[i].y = tile.at("low").at(1).get<double>() + step * y[i];
    points[i].z = tile.at("low").at(2).get<double>() + step * z[i];
  }
  std::size_t at = 6 * n;
  if (has("class")) {
    for (auto& point : points) point.label = bytes.at(at++);
  }
  if (has("plot")) {
    for (std::size_t i = 0; i < n; ++i)
      points[i].plot = bytes.at(at + i) + 256 * bytes.at(at + n + i);
    at += 2 * n;
  }
  if (has("intensity")) {
    for (auto& point : points) point.intensity = bytes.at(at++);
  }
  if (has("time")) {
    for (auto& point : points) point.time = bytes.at(at++);
  }
  return points;
}

}  // namespace plotscan::testing
