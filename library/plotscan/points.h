// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace plotscan {

// A view of positions in the caller's memory, which must stay valid: x, y and z of a point follow
// each other, metres, z up; `stride_bytes` is the distance from one point's x to the next one's.
// Readers skip points that are not finite.
class PointsView {
 public:
  PointsView(const double* x, std::size_t points, std::size_t stride_bytes = 3 * sizeof(double))
      : doubles_(reinterpret_cast<const char*>(x)), points_(points), stride_bytes_(stride_bytes) {}
  // Floats are relative to origin_m, as they are too coarse for coordinates of hundreds of
  // kilometres.
  PointsView(const float* x, std::size_t points, std::size_t stride_bytes = 3 * sizeof(float),
             const std::array<double, 3>& origin_m = {})
      : floats_(reinterpret_cast<const char*>(x)),
        points_(points),
        stride_bytes_(stride_bytes),
        origin_m_(origin_m) {}
  explicit PointsView(std::span<const std::array<double, 3>> points)
      : PointsView(points.empty() ? nullptr : points.front().data(), points.size()) {}

  std::size_t size() const { return points_; }
  std::array<double, 3> operator[](std::size_t i) const {
    std::array<double, 3> point = {};
    if (doubles_ != nullptr) {
      std::memcpy(point.data(), doubles_ + i * stride_bytes_, sizeof point);
      return point;
    }
    std::array<float, 3> relative = {};
    std::memcpy(relative.data(), floats_ + i * stride_bytes_, sizeof relative);
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = origin_m_[axis] + static_cast<double>(relative[axis]);
    return point;
  }

 private:
  const char* doubles_ = nullptr;  // one of the two
  const char* floats_ = nullptr;
  std::size_t points_;
  std::size_t stride_bytes_;
  std::array<double, 3> origin_m_ = {};
};

}  // namespace plotscan
