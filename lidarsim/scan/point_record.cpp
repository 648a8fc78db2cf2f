// SPDX-License-Identifier: Apache-2.0
#include "scan/point_record.h"

#include <bit>
#include <cstring>

#include "core/number_text.h"

namespace plotscan::scan {

static_assert(std::endian::native == std::endian::little, "records are written little-endian");

std::vector<PointRecord::Field> PointRecord::fields() const {
  const std::size_t coordinate = wide_ ? 8 : 4;
  std::vector<Field> fields = {{"x", 'F', coordinate},    {"y", 'F', coordinate},
                               {"z", 'F', coordinate},    {"intensity", 'F', 4},
                               {"ring", 'U', 2},          {"time", 'F', 8},
                               {"return_number", 'U', 1}, {"return_count", 'U', 1}};
  if (labels_)
    fields.insert(fields.end(), {{"class", 'U', 1}, {"plot", 'U', 4}, {"plant", 'U', 4}});
  return fields;
}

template <class Put>
void PointRecord::each(const LabelledPoint& point, Put&& put) const {
  if (wide_) {
    put(origin_m_.x() + point.x);
    put(origin_m_.y() + point.y);
    put(origin_m_.z() + point.z);
  } else {
    put(point.x);
    put(point.y);
    put(point.z);
  }
  put(point.intensity);
  put(point.ring);
  put(point.time);
  put(point.return_number);
  put(point.return_count);
  if (!labels_) return;
  put(static_cast<std::uint8_t>(point.label));
  put(point.plot);
  put(point.plant);
}

char* PointRecord::pack(const LabelledPoint& point, char* record) const {
  each(point, [&record](const auto& value) {
    std::memcpy(record, &value, sizeof value);
    record += sizeof value;
  });
  return record;
}

void PointRecord::print(const LabelledPoint& point, std::string& text) const {
  each(point, [&text](const auto& value) { text.append(NumberText(value)).append(" "); });
  text.back() = '\n';
}

}  // namespace plotscan::scan
