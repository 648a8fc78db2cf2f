// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "record/ros/messages.h"
#include "scan/fields.h"
#include "scan/point.h"

namespace plotscan::record {

// A cloud without points. Its fields are those of velodyne_pointcloud at the same offsets (x y z
// intensity ring time, 22 bytes), followed by our labels (return_number return_count class plot
// plant). `time` counts in seconds from the header's stamp.
ros::PointCloud2 labelled_cloud(ros::Header header);

// Adds the point to such a cloud; `position_m` is its position in the sensor's frame.
void add_point(ros::PointCloud2& cloud, const scan::LabelledPoint& point,
               const Eigen::Vector3f& position_m, float since_stamp_s);

// Reads the points of a cloud with any fields.
class CloudPoints {
 public:
  // Throws InputError where the cloud has no x, y, z, is big-endian, or its sizes do not fit its
  // data. The cloud must outlive this.
  explicit CloudPoints(const ros::PointCloud2& cloud);

  std::size_t size() const { return size_; }
  // The names of LabelledPoint's fields that the cloud has.
  std::vector<std::string> fields() const;
  // A point's position in the cloud's frame, as exact as the cloud has it.
  Eigen::Vector3d position_m(std::size_t index) const;
  // A point in the cloud's frame. Members that the cloud lacks keep their defaults; `time` is in
  // seconds since the cloud's stamp. Drivers write seconds (velodyne_pointcloud) or whole numbers
  // of nanoseconds (Ouster) since the stamp, or seconds, micro- or nanoseconds since 1970 (Hesai,
  // Robosense, Livox): whichever puts the first such point within seconds of the cloud's stamp.
  scan::LabelledPoint point(std::size_t index) const;

 private:
  struct Member {
    const scan::KnownField* known;
    scan::ScalarField field;
  };
  // How the cloud counts its points' times.
  struct Clock {
    double unit_s = 1;
    double stamp_s = 0;  // of the cloud, on that clock

    double since_stamp_s(double time) const { return unit_s * time - stamp_s; }
  };
  scan::ScalarField scalar_of(const ros::PointField& field) const;
  std::optional<Clock> find_clock() const;
  double number(std::size_t index, const scan::ScalarField& field) const;

  const ros::PointCloud2& cloud_;
  std::size_t size_ = 0;
  std::array<scan::ScalarField, 3> axes_;
  std::vector<Member> members_;  // but for the time
  std::optional<scan::ScalarField> time_;
  std::optional<Clock> clock_;  // absent: the cloud has no times that are understood
};

}  // namespace plotscan::record
