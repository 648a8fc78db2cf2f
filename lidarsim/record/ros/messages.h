// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The ROS messages of our recordings, member for member as ROS defines them; they are the same in
// ROS 1 and ROS 2 but for Header's seq. Each type names its members once, in fields(), from which
// its bytes are made and read (codec.h); its text is in internal/message_definitions.cpp. Units and
// frames are ROS's (REP 103): metres, seconds, radians; quaternions (x, y, z, w).
namespace plotscan::record::ros {

struct Time {
  std::int64_t ns = 0;  // UTC since 1970; at least 0 and until 2106 (32 bits of seconds)

  auto operator<=>(const Time&) const = default;
};

struct Header {
  std::uint32_t seq = 0;  // ROS 1 only
  Time stamp = {};
  std::string frame_id = {};

  static void fields(auto& m, auto& codec) {
    codec.ros1_only(m.seq);
    codec(m.stamp, m.frame_id);
  }
};

struct Vector3 {
  double x = 0, y = 0, z = 0;

  static void fields(auto& m, auto& codec) { codec(m.x, m.y, m.z); }
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;

  static void fields(auto& m, auto& codec) { codec(m.x, m.y, m.z, m.w); }
};

struct Transform {
  Vector3 translation = {};
  Quaternion rotation = {};

  static void fields(auto& m, auto& codec) { codec(m.translation, m.rotation); }
};

// parent_from_child, the parent being the header's frame.
struct TransformStamped {
  Header header = {};
  std::string child_frame_id = {};
  Transform transform = {};

  static void fields(auto& m, auto& codec) { codec(m.header, m.child_frame_id, m.transform); }
};

struct TFMessage {
  static constexpr const char* kType = "tf2_msgs/TFMessage";
  std::vector<TransformStamped> transforms;

  static void fields(auto& m, auto& codec) { codec(m.transforms); }
};

struct Clock {
  static constexpr const char* kType = "rosgraph_msgs/Clock";
  Time clock;

  static void fields(auto& m, auto& codec) { codec(m.clock); }
};

struct PointField {
  static constexpr std::uint8_t kInt8 = 1, kUint8 = 2, kInt16 = 3, kUint16 = 4, kInt32 = 5,
                                kUint32 = 6, kFloat32 = 7, kFloat64 = 8;
  std::string name;
  std::uint32_t offset = 0;  // bytes from the point's start
  std::uint8_t datatype = 0;
  std::uint32_t count = 1;

  static void fields(auto& m, auto& codec) { codec(m.name, m.offset, m.datatype, m.count); }
};

struct PointCloud2 {
  static constexpr const char* kType = "sensor_msgs/PointCloud2";
  Header header = {};
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<PointField> point_fields = {};
  bool is_bigendian = false;
  std::uint32_t point_step = 0;  // bytes
  std::uint32_t row_step = 0;    // bytes
  std::vector<std::uint8_t> data = {};
  bool is_dense = true;  // no NaN

  static void fields(auto& m, auto& codec) {
    codec(m.header, m.height, m.width, m.point_fields, m.is_bigendian, m.point_step, m.row_step,
          m.data, m.is_dense);
  }
};

// Covariances row by row; all 0: unknown.
using Covariance = std::array<double, 9>;

struct Imu {
  static constexpr const char* kType = "sensor_msgs/Imu";
  Header header = {};
  Quaternion orientation = {};
  Covariance orientation_covariance = {};
  Vector3 angular_velocity = {};
  Covariance angular_velocity_covariance = {};
  Vector3 linear_acceleration = {};  // specific force: gravity is in it (REP 145)
  Covariance linear_acceleration_covariance = {};

  static void fields(auto& m, auto& codec) {
    codec(m.header, m.orientation, m.orientation_covariance, m.angular_velocity,
          m.angular_velocity_covariance, m.linear_acceleration, m.linear_acceleration_covariance);
  }
};

struct NavSatStatus {
  static constexpr std::int8_t kFix = 0;
  static constexpr std::uint16_t kGps = 1;
  std::int8_t status = kFix;
  std::uint16_t service = kGps;

  static void fields(auto& m, auto& codec) { codec(m.status, m.service); }
};

struct NavSatFix {
  static constexpr const char* kType = "sensor_msgs/NavSatFix";
  Header header = {};
  NavSatStatus status = {};
  double latitude = 0;   // degrees, WGS84
  double longitude = 0;  // degrees, WGS84
  double altitude = 0;   // metres over the ellipsoid
  Covariance position_covariance = {};
  std::uint8_t position_covariance_type = 0;  // 0: unknown

  static void fields(auto& m, auto& codec) {
    codec(m.header, m.status, m.latitude, m.longitude, m.altitude, m.position_covariance,
          m.position_covariance_type);
  }
};

struct VelodynePacket {
  Time stamp = {};
  std::array<std::uint8_t, 1206> data{};

  static void fields(auto& m, auto& codec) { codec(m.stamp, m.data); }
};

struct VelodyneScan {
  static constexpr const char* kType = "velodyne_msgs/VelodyneScan";
  Header header = {};
  std::vector<VelodynePacket> packets = {};

  static void fields(auto& m, auto& codec) { codec(m.header, m.packets); }
};

}  // namespace plotscan::record::ros
