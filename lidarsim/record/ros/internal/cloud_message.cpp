// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/cloud_message.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/error.h"

namespace plotscan::record {
namespace {

using ros::PointField;

// By PointField's datatypes, which count from 1.
constexpr std::string_view kKinds = "IUIUIUFF";
constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};

const PointField* find_exactly(const ros::PointCloud2& cloud, std::string_view name) {
  const auto found = std::ranges::find(cloud.point_fields, name, &PointField::name);
  return found == cloud.point_fields.end() ? nullptr : &*found;
}

// The first field that has one of the names by which drivers call a field of LabelledPoint. Labels
// are ours alone: other programs' mean something else.
const PointField* find_field(const ros::PointCloud2& cloud, const scan::KnownField& known) {
  if (const PointField* ours = find_exactly(cloud, known.name)) return ours;
  if (known.name == "class" || known.name == "plot" || known.name == "plant") return nullptr;
  for (const std::string& plain : known.plain_names)
    for (const PointField& field : cloud.point_fields)
      if (scan::plain_name(field.name) == plain) return &field;
  return nullptr;
}

}  // namespace

ros::PointCloud2 labelled_cloud(ros::Header header) {
  ros::PointCloud2 cloud{.header = std::move(header)};
  const auto add = [&](const char* name, std::uint8_t datatype) {
    cloud.point_fields.push_back(
        {.name = name, .offset = cloud.point_step, .datatype = datatype, .count = 1});
    cloud.point_step += static_cast<std::uint32_t>(kSizes[datatype - 1u]);
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
  for (std::size_t axis = 0; axis < axes_.size(); ++axis)
    axes_[axis] = scalar_of(*find_exactly(cloud, std::string_view("xyz").substr(axis, 1)));
  for (const scan::KnownField& known : scan::known_fields()) {
    const PointField* found = find_field(cloud, known);
    if (found == nullptr) continue;
    if (known.name == "time")
      time_ = scalar_of(*found);
    else
      members_.push_back({&known, scalar_of(*found)});
  }
  if (time_) clock_ = find_clock();
}

scan::ScalarField CloudPoints::scalar_of(const PointField& field) const {
  if (field.datatype < PointField::kInt8 || field.datatype > PointField::kFloat64)
    throw InputError("a cloud's field has the unknown type " + std::to_string(field.datatype));
  const std::size_t type = field.datatype - 1u;
  if (std::uint64_t{field.offset} + kSizes[type] > cloud_.point_step)
    throw InputError("a cloud's field " + field.name + " lies outside of its points");
  return {.name = field.name, .kind = kKinds[type], .size = kSizes[type], .offset = field.offset};
}

// What a driver writes lies within seconds of the cloud's stamp.
std::optional<CloudPoints::Clock> CloudPoints::find_clock() const {
  constexpr double kNear_s = 10;
  const double stamp_s = 1e-9 * static_cast<double>(cloud_.header.stamp.ns);
  const std::vector<Clock> clocks = {
      {scan::time_unit_s(*time_), 0}, {1, stamp_s}, {1e-6, stamp_s}, {1e-9, stamp_s}};
  if (size_ == 0) return clocks.front();
  for (std::size_t i = 0; i < size_; ++i) {
    const double read = number(i, *time_);
    for (const Clock& clock : clocks)
      if (std::abs(clock.since_stamp_s(read)) <= kNear_s) return clock;
  }
  return std::nullopt;
}

std::vector<std::string> CloudPoints::fields() const {
  std::vector<std::string> names = {"x", "y", "z"};
  for (const Member& member : members_) names.push_back(member.known->name);
  if (clock_) names.emplace_back("time");
  return names;
}

double CloudPoints::number(std::size_t index, const scan::ScalarField& field) const {
  const std::uint8_t* point = cloud_.data.data() + index / cloud_.width * cloud_.row_step +
                              index % cloud_.width * cloud_.point_step;
  return decode(field, reinterpret_cast<const char*>(point + field.offset), false);
}

Eigen::Vector3d CloudPoints::position_m(std::size_t index) const {
  return {number(index, axes_[0]), number(index, axes_[1]), number(index, axes_[2])};
}

scan::LabelledPoint CloudPoints::point(std::size_t index) const {
  const Eigen::Vector3f place = position_m(index).cast<float>();
  scan::LabelledPoint point{.x = place.x(), .y = place.y(), .z = place.z()};
  for (const auto& [known, field] : members_) {
    if (!known->put(point, number(index, field)) && known->name != "intensity")
      throw InputError("a cloud's ring or label is out of range");
  }
  if (!std::isfinite(point.intensity)) point.intensity = 0;
  if (clock_) point.time = clock_->since_stamp_s(number(index, *time_));
  return point;
}

}  // namespace plotscan::record
