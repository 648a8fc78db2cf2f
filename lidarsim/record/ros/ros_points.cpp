// SPDX-License-Identifier: Apache-2.0
#include "record/ros/ros_points.h"

#include <cmath>
#include <map>

#include "core/contains.h"
#include "core/error.h"
#include "core/text.h"
#include "record/ros/internal/cloud_message.h"
#include "record/ros/message_file.h"
#include "scan/point_reader.h"

namespace plotscan::record {
namespace {

constexpr const char* kVelodynePoints = "/velodyne_points";
constexpr std::int64_t kMicrosecond_ns = 1000;

// The clouds of one topic.
struct CloudTopic {
  std::string frame;
  std::uint64_t points = 0;
  std::vector<std::string> fields;
  std::optional<Eigen::Vector3d> first_m;  // the first finite point, in its frame
  std::string error;                       // why its clouds cannot be read; "" if they can
};

using CloudTopics = std::map<std::string, CloudTopic>;

std::optional<Eigen::Vector3d> first_finite(const CloudPoints& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const Eigen::Vector3d position_m = points.position_m(i); position_m.allFinite())
      return position_m;
  return std::nullopt;
}

void take_cloud(const ros::PointCloud2& cloud, CloudTopic& topic) {
  topic.frame = cloud.header.frame_id;
  topic.points += std::uint64_t{cloud.width} * cloud.height;
  try {
    const CloudPoints points(cloud);
    if (topic.fields.empty() || points.size() > 0) topic.fields = points.fields();
    if (!topic.first_m) topic.first_m = first_finite(points);
  } catch (const InputError& error) {  // another topic may be wanted
    topic.error = error.what();
  }
}

std::string choose(const CloudTopics& topics, const std::string& wanted) {
  if (topics.empty()) throw InputError("holds no clouds (sensor_msgs/PointCloud2)");
  std::vector<std::string> names, readable;
  for (const auto& [name, topic] : topics) {
    names.push_back(name);
    if (topic.error.empty()) readable.push_back(name);
  }
  if (!wanted.empty() && !topics.contains(wanted))
    throw InputError("holds no clouds of topic " + wanted + "; it has " + joined(names, ", "));
  if (!wanted.empty()) return wanted;
  if (topics.contains(kVelodynePoints)) return kVelodynePoints;
  if (readable.size() > 1) {
    throw InputError("holds clouds of several topics; choose one by --topic: " +
                     joined(readable, ", "));
  }
  return readable.empty() ? names.front() : readable.front();
}

// The point at a position in its frame, placed in the world frame relative to origin_m, its time
// unchanged; absent if no transform is known for its time.
std::optional<scan::LabelledPoint> placed(scan::LabelledPoint point,
                                          const Eigen::Vector3d& position_m, const FramePath& path,
                                          const Eigen::Vector3d& origin_m) {
  if (!position_m.allFinite() || !std::isfinite(point.time)) return std::nullopt;
  const auto top_from_frame = path.top_from_frame(point.time);
  if (!top_from_frame) return std::nullopt;
  const Eigen::Vector3f world = (*top_from_frame * position_m - origin_m).cast<float>();
  if (!world.allFinite()) return std::nullopt;
  point.x = world.x();
  point.y = world.y();
  point.z = world.z();
  return point;
}

// Where the body is first, or the first point of clouds that stand still.
Eigen::Vector3d first_place(const FramePath& path, const CloudTopic& clouds) {
  if (const auto motion = path.motion()) return motion->poses().front().position_m;
  const auto top_from_frame = path.top_from_frame(0);
  if (!top_from_frame || !clouds.first_m) return Eigen::Vector3d::Zero();
  return *top_from_frame * *clouds.first_m;
}

}  // namespace

RosPoints::RosPoints(const std::filesystem::path& file, const std::string& topic) : file_(file) {
  RosTransforms transforms;
  CloudTopics clouds;
  bool is_first = true;
  ros::read_messages(file, [&](const ros::Message& message) {
    if (is_first) start_.ns = message.time.ns / kMicrosecond_ns * kMicrosecond_ns;
    is_first = false;
    if (message.topic.type == ros::TFMessage::kType || message.topic.type == "tf/tfMessage") {
      transforms.add(ros::decode<ros::TFMessage>(message.version, message.bytes), start_,
                     message.topic.name == "/tf_static");
    } else if (message.topic.type == ros::PointCloud2::kType) {
      take_cloud(ros::decode<ros::PointCloud2>(message.version, message.bytes),
                 clouds[message.topic.name]);
    }
  });
  try {
    topic_ = choose(clouds, topic);
    const CloudTopic& chosen = clouds.at(topic_);
    if (!chosen.error.empty()) throw InputError(chosen.error);
    points_ = chosen.points;
    fields_ = chosen.fields;
    path_ = transforms.path(chosen.frame);
    origin_m_ = scan::origin_near(first_place(path_, chosen));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

UtcTime RosPoints::start() const {
  return UtcTime(std::chrono::microseconds(start_.ns / kMicrosecond_ns));
}

std::vector<std::string> RosPoints::notes() const {
  if (contains(fields_, "time") || !trajectory()) return {};
  return {"the clouds of " + topic_ +
          " have no times of their points (time, t, timestamp; seconds, or nanoseconds as whole "
          "numbers): each point is placed where the sensor was at its cloud's stamp"};
}

scan::CloudSummary RosPoints::stream(const scan::PointSink& sink) const {
  scan::CloudSummary summary;
  std::vector<scan::LabelledPoint> sweep;
  ros::read_messages(file_, [&](const ros::Message& message) {
    if (message.topic.name != topic_ || message.topic.type != ros::PointCloud2::kType) return;
    const auto cloud = ros::decode<ros::PointCloud2>(message.version, message.bytes);
    const double stamp_s = 1e-9 * static_cast<double>(cloud.header.stamp.ns - start_.ns);
    const CloudPoints points(cloud);
    sweep.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      scan::LabelledPoint read = points.point(i);
      read.time += stamp_s;
      if (const auto point = placed(read, points.position_m(i), path_, origin_m_))
        sweep.push_back(*point);
    }
    summary.points += sweep.size();
    summary.not_finite += points.size() - sweep.size();
    if (!sweep.empty()) sink(sweep);
  });
  if (summary.points == 0)
    throw InputError(file_, "no point of " + topic_ + " is finite and has a transform");
  return summary;
}

}  // namespace plotscan::record
