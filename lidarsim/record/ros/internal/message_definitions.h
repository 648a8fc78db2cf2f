// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "record/ros/codec.h"

namespace plotscan::record::ros {

// The definition of a type ("sensor_msgs/Imu"), followed by those of all types it is made of, as
// bags hold them: the text of .msg files without comments. The type must be one of ros/messages.h.
std::string message_definition(const std::string& type, Version version);

// The hash by which ROS 1 identifies the version of a type. The tests compare it with ROS's own.
std::string md5_sum(const std::string& type);

// "sensor_msgs/msg/Imu" of "sensor_msgs/Imu".
std::string ros2_name(const std::string& type);

}  // namespace plotscan::record::ros
