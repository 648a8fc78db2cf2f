// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace plotscan::report {

// The most points of a page: it still draws smoothly and stays under 40 MB.
inline constexpr std::size_t kMostPoints = 5'000'000;

// A point as a page shows it.
struct ShownPoint {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();  // relative to ShownCloud::origin, metres
  float intensity = 0;                              // 0 to 255
  float time_s = 0;                                 // counts from ShownCloud::time_origin_s
  std::uint32_t plot = 0;                           // the plot's number; 0: none
  std::uint8_t label = 0;                           // scan::PointClass
};

// What a page shows of a cloud, and which fields of its points mean something.
struct ShownCloud {
  std::vector<ShownPoint> points = {};
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // in the cloud's frame, metres
  double time_origin_s = 0;  // floats tell times of day apart, but not those since 1970 or 1980
  std::uint64_t read = 0;    // points in the whole cloud, shown or not
  bool has_class = false;
  bool has_plot = false;
  bool has_intensity = false;
  bool has_time = false;
};

// Takes a random sample of a stream of points, in which each point is equally likely. Memory is
// bounded by the sample's size. The same points in the same order give the same sample.
class CloudSample {
 public:
  // Throws InputError unless `most` is 1 to kMostPoints.
  explicit CloudSample(std::size_t most);

  void add(const ShownPoint& point);
  std::uint64_t read() const { return read_; }
  // At most `most` of the points that were added, each as likely as any other. Call it once: the
  // sample is moved out.
  std::vector<ShownPoint> take();

 private:
  struct Drawn {
    std::uint64_t lot;  // the points with the lowest lots stay
    ShownPoint point;
  };
  void keep_lowest();

  std::size_t most_;
  std::uint64_t read_ = 0;
  std::uint64_t highest_lot_;
  std::vector<Drawn> drawn_;
};

}  // namespace plotscan::report
