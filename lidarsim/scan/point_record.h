// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scan/point.h"

namespace plotscan::scan {

// The most bytes that pack writes.
inline constexpr std::size_t kMaxPackedPointSize = 49;

// A LabelledPoint as PCD and PLY files store it: its fields one after the other, little-endian,
// without padding: 37 bytes, or 49 where an origin makes x, y and z doubles; 9 less without the
// labels class, plot and plant.
class PointRecord {
 public:
  struct Field {
    std::string name;
    char kind;  // F or U, as in PCD
    std::size_t size;
  };

  // Points lie at origin_m + (x, y, z).
  explicit PointRecord(const Eigen::Vector3d& origin_m, bool labels = true)
      : origin_m_(origin_m), wide_(!origin_m.isZero(0)), labels_(labels) {}

  std::vector<Field> fields() const;
  std::size_t size() const {
    return kMaxPackedPointSize - (wide_ ? 0 : 12) - (labels_ ? 0 : kLabelsSize);
  }
  // Writes the point's record at `record`; returns its end.
  char* pack(const LabelledPoint& point, char* record) const;
  // Appends the fields with blanks between them and a line's end; every number reads back exactly.
  void print(const LabelledPoint& point, std::string& text) const;

 private:
  template <class Put>
  void each(const LabelledPoint& point, Put&& put) const;

  static constexpr std::size_t kLabelsSize = 9;

  Eigen::Vector3d origin_m_;
  bool wide_;
  bool labels_;
};

}  // namespace plotscan::scan
