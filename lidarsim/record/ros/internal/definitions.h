// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "record/ros/codec.h"

namespace plotscan::record::ros {

// The definition of a type ("sensor_msgs/Imu") and, behind it, of all types it is made of, as bags
// hold it: the text of .msg files without their comments. One of ros_messages.h's types.
std::string message_definition(const std::string& type, Version version);

// What ROS 1 knows the version of a type by. The tests hold it against ROS's own.
std::string md5_sum(const std::string& type);

// "sensor_msgs/msg/Imu" of "sensor_msgs/Imu".
std::string ros2_name(const std::string& type);

}  // namespace plotscan::record::ros
