// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/cloud.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "scan/field_names.h"

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

const PointField* find_exactly(const ros::PointCloud2& cloud, const char* name) {
  const auto found = std::ranges::find(cloud.point_fields, name, &PointField::name);
  return found == cloud.point_fields.end() ? nullptr : &*found;
}

// The first field that has one of the names by which drivers call a field of LabelledPoint.
const PointField* find_field(const ros::PointCloud2& cloud, const char* name) {
  if (const PointField* ours = find_exactly(cloud, name)) return ours;
  for (const std::string& plain : scan::plain_names_of(name))
    for (const PointField& field : cloud.point_fields)
      if (scan::plain_name(field.name) == plain) return &field;
  return nullptr;
}

// Labels are ours alone: other programs' mean something else.
const PointField* find_label(const ros::PointCloud2& cloud, const char* name) {
  return find_exactly(cloud, name);
}

bool is_whole(std::uint8_t datatype) {
  return datatype != PointField::kFloat32 && datatype != PointField::kFloat64;
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
    if (!find_exactly(cloud, axis)) throw InputError("a cloud has no fields x, y and z");
  const std::uint64_t step = cloud.point_step;
  if (cloud.width > 0 && cloud.height > 0 &&
      (step == 0 || step * cloud.width > cloud.row_step ||
       std::uint64_t{cloud.row_step} * cloud.height > cloud.data.size()))
    throw InputError("a cloud's sizes do not fit its data");
  size_ = std::size_t{cloud.width} * cloud.height;
  x_ = field(find_exactly(cloud, "x"));
  y_ = field(find_exactly(cloud, "y"));
  z_ = field(find_exactly(cloud, "z"));
  intensity_ = field(find_field(cloud, "intensity"));
  ring_ = field(find_field(cloud, "ring"));
  time_ = field(find_field(cloud, "time"));
  return_number_ = field(find_field(cloud, "return_number"));
  return_count_ = field(find_field(cloud, "return_count"));
  class_ = field(find_label(cloud, "class"));
  plot_ = field(find_label(cloud, "plot"));
  plant_ = field(find_label(cloud, "plant"));
  if (time_) clock_ = clock_of(*time_);
}

// What a driver writes lies within seconds of the cloud's stamp.
std::optional<CloudPoints::Clock> CloudPoints::clock_of(const Field& time) const {
  constexpr double kNear_s = 10;
  const double stamp_s = 1e-9 * static_cast<double>(cloud_.header.stamp.ns);
  const double unit_s = is_whole(time.datatype) ? 1e-9 : 1;
  const std::vector<Clock> clocks = {{unit_s, 0}, {1, stamp_s}, {1e-6, stamp_s}, {1e-9, stamp_s}};
  if (size_ == 0) return clocks.front();
  for (std::size_t i = 0; i < size_; ++i) {
    const double read = number(bytes_of(i), time);
    for (const Clock& clock : clocks)
      if (std::abs(clock.since_stamp_s(read)) <= kNear_s) return clock;
  }
  return std::nullopt;
}

std::vector<std::string> CloudPoints::fields() const {
  std::vector<std::string> names = {"x", "y", "z"};
  const auto add = [&](const std::optional<Field>& field, const char* name) {
    if (field) names.emplace_back(name);
  };
  add(intensity_, "intensity");
  add(ring_, "ring");
  add(return_number_, "return_number");
  add(return_count_, "return_count");
  add(class_, "class");
  add(plot_, "plot");
  add(plant_, "plant");
  if (clock_) names.emplace_back("time");
  return names;
}

std::optional<CloudPoints::Field> CloudPoints::field(const ros::PointField* found) const {
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
  if (clock_) point.time = clock_->since_stamp_s(number(at, *time_));
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
