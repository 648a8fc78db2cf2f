// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/cloud.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"

namespace plotscan::record {
namespace {

using ros::PointField;

std::size_t size_of(std::uint8_t datatype) {
  switch (datatype) {
    case PointField::kInt8:
    case PointField::kUint8:
      return 1;
    case PointField::kInt16:
    case PointField::kUint16:
      return 2;
    case PointField::kInt32:
    case PointField::kUint32:
    case PointField::kFloat32:
      return 4;
    case PointField::kFloat64:
      return 8;
    default:
      throw InputError("a cloud's field has the unknown type " + std::to_string(datatype));
  }
}

template <class Number>
double read_as(const std::uint8_t* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

const PointField* find_field(const ros::PointCloud2& cloud, const char* name) {
  const auto found = std::ranges::find(cloud.point_fields, name, &PointField::name);
  return found == cloud.point_fields.end() ? nullptr : &*found;
}

}  // namespace

ros::PointCloud2 labelled_cloud(ros::Header header) {
  ros::PointCloud2 cloud{.header = std::move(header)};
  const auto add = [&](const char* name, std::uint8_t datatype) {
    cloud.point_fields.push_back(
        {.name = name, .offset = cloud.point_step, .datatype = datatype, .count = 1});
    cloud.point_step += static_cast<std::uint32_t>(size_of(datatype));
  };
  for (const char* name : {"x", "y", "z", "intensity"}) add(name, PointField::kFloat32);
  add("ring", PointField::kUint16);
  add("time", PointField::kFloat32);
  for (const char* name : {"return_number", "return_count", "class"}) add(name, PointField::kUint8);
  for (const char* name : {"plot", "plant"}) add(name, PointField::kUint32);
  return cloud;
}

void add_point(ros::PointCloud2& cloud, const scan::LabelledPoint& point,
               const Eigen::Vector3f& position_m, float since_stamp_s) {
  const std::size_t begin = cloud.data.size();
  cloud.data.resize(begin + cloud.point_step);
  std::uint8_t* at = cloud.data.data() + begin;
  const auto put = [&at](const auto& value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  };
  put(position_m.x());
  put(position_m.y());
  put(position_m.z());
  put(point.intensity);
  put(point.ring);
  put(since_stamp_s);
  put(point.return_number);
  put(point.return_count);
  put(point.label);
  put(point.plot);
  put(point.plant);
  ++cloud.width;
  cloud.row_step = cloud.width * cloud.point_step;
}

CloudPoints::CloudPoints(const ros::PointCloud2& cloud) : cloud_(cloud) {
  if (cloud.is_bigendian) throw InputError("a cloud is big-endian; little-endian ones are read");
  for (const char* axis : {"x", "y", "z"})
    if (!find_field(cloud, axis)) throw InputError("a cloud has no fields x, y and z");
  const std::uint64_t step = cloud.point_step;
  if (cloud.width > 0 && cloud.height > 0 &&
      (step == 0 || step * cloud.width > cloud.row_step ||
       std::uint64_t{cloud.row_step} * cloud.height > cloud.data.size()))
    throw InputError("a cloud's sizes do not fit its data");
  size_ = std::size_t{cloud.width} * cloud.height;
  x_ = field("x");
  y_ = field("y");
  z_ = field("z");
  intensity_ = field("intensity");
  ring_ = field("ring");
  time_ = field("time");
  time_ns_ = field("t");
  return_number_ = field("return_number");
  return_count_ = field("return_count");
  class_ = field("class");
  plot_ = field("plot");
  plant_ = field("plant");
}

std::vector<std::string> CloudPoints::fields() const {
  std::vector<std::string> names = {"x", "y", "z"};
  for (const char* name :
       {"intensity", "ring", "return_number", "return_count", "class", "plot", "plant"})
    if (find_field(cloud_, name) != nullptr) names.emplace_back(name);
  if (time_ || time_ns_) names.emplace_back("time");
  return names;
}

std::optional<CloudPoints::Field> CloudPoints::field(const char* name) const {
  const PointField* found = find_field(cloud_, name);
  if (found == nullptr) return std::nullopt;
  if (std::uint64_t{found->offset} + size_of(found->datatype) > cloud_.point_step)
    throw InputError("a cloud's field " + found->name + " lies outside of its points");
  return Field{.offset = found->offset, .datatype = found->datatype};
}

double CloudPoints::number(const std::uint8_t* point, const Field& field) const {
  const std::uint8_t* at = point + field.offset;
  switch (field.datatype) {
    case PointField::kInt8:
      return read_as<std::int8_t>(at);
    case PointField::kUint8:
      return read_as<std::uint8_t>(at);
    case PointField::kInt16:
      return read_as<std::int16_t>(at);
    case PointField::kUint16:
      return read_as<std::uint16_t>(at);
    case PointField::kInt32:
      return read_as<std::int32_t>(at);
    case PointField::kUint32:
      return read_as<std::uint32_t>(at);
    case PointField::kFloat32:
      return read_as<float>(at);
    default:
      return read_as<double>(at);
  }
}

// Sets the value from the field, if there is one. Throws InputError if it does not fit a
// whole-number type.
template <class Value>
void CloudPoints::set(Value& value, const std::uint8_t* point,
                      const std::optional<Field>& field) const {
  if (!field) return;
  const double read = number(point, *field);
  if constexpr (std::is_integral_v<Value>) {
    if (!(read >= 0 && read <= static_cast<double>(std::numeric_limits<Value>::max())))
      throw InputError("a cloud's ring or label is out of range");
  }
  value = static_cast<Value>(read);
}

const std::uint8_t* CloudPoints::bytes_of(std::size_t index) const {
  return cloud_.data.data() + index / cloud_.width * cloud_.row_step +
         index % cloud_.width * cloud_.point_step;
}

Eigen::Vector3d CloudPoints::position_m(std::size_t index) const {
  const std::uint8_t* at = bytes_of(index);
  return {number(at, *x_), number(at, *y_), number(at, *z_)};
}

scan::LabelledPoint CloudPoints::point(std::size_t index) const {
  const std::uint8_t* at = bytes_of(index);
  scan::LabelledPoint point;
  set(point.x, at, x_);
  set(point.y, at, y_);
  set(point.z, at, z_);
  set(point.intensity, at, intensity_);
  if (!std::isfinite(point.intensity)) point.intensity = 0;
  set(point.ring, at, ring_);
  set(point.time, at, time_);
  if (!time_ && time_ns_) point.time = 1e-9 * number(at, *time_ns_);
  set(point.return_number, at, return_number_);
  set(point.return_count, at, return_count_);
  std::uint8_t label = 0;
  set(label, at, class_);
  // Numbers that are none of our classes become PointClass::other.
  point.label = label <= static_cast<std::uint8_t>(scan::PointClass::other)
                    ? static_cast<scan::PointClass>(label)
                    : scan::PointClass::other;
  set(point.plot, at, plot_);
  set(point.plant, at, plant_);
  return point;
}

}  // namespace plotscan::record
