// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/message_definitions.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/contains.h"
#include "core/error.h"

namespace plotscan::record::ros {
namespace {

struct Definition {
  std::string_view type;
  std::string_view md5;   // "" for types that are not a topic's
  std::string_view text;  // as in ROS 2; types of other packages have full names
};

constexpr std::array kDefinitions = {
    Definition{"builtin_interfaces/Time", "", "int32 sec\nuint32 nanosec\n"},
    Definition{"std_msgs/Header", "", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"geometry_msgs/Vector3", "", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Quaternion", "", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Definition{"geometry_msgs/Transform", "",
               "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Definition{"geometry_msgs/TransformStamped", "",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/Transform transform\n"},
    Definition{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec",
               "geometry_msgs/TransformStamped[] transforms\n"},
    Definition{"rosgraph_msgs/Clock", "a9c97c1d230cfc112e270351a944ee47",
               "builtin_interfaces/Time clock\n"},
    Definition{"sensor_msgs/PointField", "",
               "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
               "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
               "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    Definition{"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181",
               "std_msgs/Header header\nuint32 height\nuint32 width\n"
               "sensor_msgs/PointField[] fields\nbool is_bigendian\nuint32 point_step\n"
               "uint32 row_step\nuint8[] data\nbool is_dense\n"},
    Definition{"sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2",
               "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
               "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
               "float64[9] angular_velocity_covariance\n"
               "geometry_msgs/Vector3 linear_acceleration\n"
               "float64[9] linear_acceleration_covariance\n"},
    Definition{"sensor_msgs/NavSatStatus", "",
               "int8 STATUS_NO_FIX=-1\nint8 STATUS_FIX=0\nint8 STATUS_SBAS_FIX=1\n"
               "int8 STATUS_GBAS_FIX=2\nint8 status\nuint16 SERVICE_GPS=1\n"
               "uint16 SERVICE_GLONASS=2\nuint16 SERVICE_COMPASS=4\nuint16 SERVICE_GALILEO=8\n"
               "uint16 service\n"},
    Definition{"sensor_msgs/NavSatFix", "2d3a8cd499b9b4a0249fb98fd05cfa48",
               "std_msgs/Header header\nsensor_msgs/NavSatStatus status\nfloat64 latitude\n"
               "float64 longitude\nfloat64 altitude\nfloat64[9] position_covariance\n"
               "uint8 COVARIANCE_TYPE_UNKNOWN=0\nuint8 COVARIANCE_TYPE_APPROXIMATED=1\n"
               "uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2\nuint8 COVARIANCE_TYPE_KNOWN=3\n"
               "uint8 position_covariance_type\n"},
    // ros-drivers/velodyne; Debian has no package of it.
    Definition{"velodyne_msgs/VelodynePacket", "",
               "builtin_interfaces/Time stamp\nuint8[1206] data\n"},
    Definition{"velodyne_msgs/VelodyneScan", "50804fc9533a0e579e6322c04ae70566",
               "std_msgs/Header header\nvelodyne_msgs/VelodynePacket[] packets\n"},
};

const Definition& definition_of(std::string_view type) {
  const auto* found = std::ranges::find(kDefinitions, type, &Definition::type);
  check(found != kDefinitions.end(), "no definition of " + std::string(type));
  return *found;
}

// The types of the members that are messages themselves, in the order of the members.
std::vector<std::string> parts_of(const Definition& definition) {
  std::vector<std::string> parts;
  std::istringstream lines{std::string(definition.text)};
  for (std::string line; std::getline(lines, line);) {
    const std::string type = line.substr(0, line.find_first_of(" ["));
    if (type.find('/') != std::string::npos) parts.push_back(type);
  }
  return parts;
}

void collect(const Definition& definition, std::vector<const Definition*>& all) {
  if (contains(all, &definition)) return;
  all.push_back(&definition);
  for (const std::string& part : parts_of(definition)) collect(definition_of(part), all);
}

// The text as in ROS 1, where time is a built-in type and headers have a sequence number.
std::string ros1_text(const Definition& definition) {
  constexpr std::string_view kTime = "builtin_interfaces/Time";
  std::string text(definition.text);
  for (auto at = text.find(kTime); at != std::string::npos; at = text.find(kTime))
    text.replace(at, kTime.size(), "time");
  return definition.type == "std_msgs/Header" ? "uint32 seq\n" + text : text;
}

}  // namespace

std::string message_definition(const std::string& type, Version version) {
  std::vector<const Definition*> all;
  collect(definition_of(type), all);
  std::string text;
  for (const Definition* definition : all) {
    if (version == Version::ros1 && definition->type == "builtin_interfaces/Time") continue;
    if (!text.empty())
      text += std::string(80, '=') + "\nMSG: " + std::string(definition->type) + "\n";
    text += version == Version::ros1 ? ros1_text(*definition) : definition->text;
  }
  return text;
}

std::string md5_sum(const std::string& type) { return std::string(definition_of(type).md5); }

std::string ros2_name(const std::string& type) {
  const auto slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

}  // namespace plotscan::record::ros
