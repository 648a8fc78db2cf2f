// SPDX-License-Identifier: Apache-2.0
#include "farmbench/export/internal/labelled_scans.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/error.h"
#include "core/text_file.h"
#include "record/open_source.h"
#include "record/scan_folder.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

constexpr double kUnturned_s = 0.1;  // a scan of a sensor that does not turn
constexpr std::uint32_t kGreatestPlotId = 0xFFFF;

template <class Value>
void write_values(const fs::path& file, const std::vector<Value>& values) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(Value)));
  if (!out.flush()) throw WriteError(file);
}

// KITTI's poses are a camera's, and its calib.txt has the transform from the lidar to that camera
// (Tr), with which loaders bring the poses to the lidar. These poses are the lidar's own, so Tr is
// the identity. There are no cameras: P0 to P3, which some loaders ask for, stand for none.
void write_calibration(const fs::path& file) {
  TextFile out(file);
  for (const char* matrix : {"P0", "P1", "P2", "P3", "Tr"})
    out << matrix << ": 1 0 0 0 0 1 0 0 0 0 1 0\n";
  out.close();
}

// Collects the points of one turn after the other.
class ScanWriter {
 public:
  ScanWriter(const record::FlightRecord& flight, fs::path sequence)
      : flight_(flight),
        sequence_(std::move(sequence)),
        turn_s_(flight.spin_hz > 0 ? 1 / flight.spin_hz : kUnturned_s),
        poses_(sequence_ / "poses.txt"),
        times_(sequence_ / "times.txt") {
    for (const char* part : {"velodyne", "labels", "plants"})
      fs::create_directories(sequence_ / part);
  }

  void add(const scan::LabelledPoint& point) {
    const auto turn = static_cast<std::int64_t>(std::floor(point.time / turn_s_));
    if (turn != turn_) start(turn);
    const Eigen::Vector3d own =
        lidar_from_world_ * Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
    for (const double value : {own.x(), own.y(), own.z(), point.intensity / 255.0})
      points_.push_back(static_cast<float>(value));
    if (point.plot > kGreatestPlotId)
      throw InputError("a plot's id is " + std::to_string(point.plot) +
                       "; labels have 16 bits for it, up to 65535");
    labels_.push_back(static_cast<std::uint32_t>(point.label) | point.plot << 16);
    plants_.push_back(point.plant);
    ++counts_.points;
    ++counts_.by_class.at(static_cast<std::size_t>(point.label));
  }

  ScanCounts close() {
    finish();
    poses_.close();
    times_.close();
    return counts_;
  }

 private:
  void start(std::int64_t turn) {
    finish();
    turn_ = turn;
    const double time_s = static_cast<double>(turn) * turn_s_;
    const Eigen::Isometry3d world_from_lidar =
        flight_.reported.world_from_body(time_s) * flight_.body_from_lidar;
    lidar_from_world_ = world_from_lidar.inverse();
    times_ << time_s << "\n";
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        poses_ << world_from_lidar.matrix()(row, column);
        poses_ << (row == 2 && column == 3 ? "\n" : " ");
      }
    }
  }

  void finish() {
    if (points_.empty()) return;
    const std::string name = fmt::format("{:06}", counts_.scans++);
    write_values(sequence_ / "velodyne" / (name + ".bin"), points_);
    write_values(sequence_ / "labels" / (name + ".label"), labels_);
    write_values(sequence_ / "plants" / (name + ".plant"), plants_);
    points_.clear();
    labels_.clear();
    plants_.clear();
  }

  const record::FlightRecord& flight_;
  fs::path sequence_;
  double turn_s_;
  TextFile poses_;
  TextFile times_;
  std::int64_t turn_ = -1;
  Eigen::Isometry3d lidar_from_world_ = Eigen::Isometry3d::Identity();
  std::vector<float> points_;
  std::vector<std::uint32_t> labels_;
  std::vector<std::uint32_t> plants_;
  ScanCounts counts_;
};

}  // namespace

ScanCounts write_labelled_scans(const fs::path& scan, const fs::path& sequence) {
  const record::FlightRecord flight = record::read_flight_record(scan);
  write_calibration(sequence / "calib.txt");
  ScanWriter writer(flight, sequence);
  record::open_source(scan, {}).stream([&](std::span<const scan::LabelledPoint> points) {
    for (const scan::LabelledPoint& point : points) writer.add(point);
  });
  return writer.close();
}

}  // namespace plotscan::farmbench
