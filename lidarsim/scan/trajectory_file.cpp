// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "core/csv.h"
#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"
#include "core/text_file.h"
#include "scan/trajectory.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kColumns = 8;

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = {"t_s", "x_m", "y_m", "z_m",
                                                 "qx",  "qy",  "qz",  "qw"};
  return names;
}

// Appends the pose of a line's numbers; returns what is wrong with it, "" if nothing is.
std::string append_pose(const std::array<double, kColumns>& v, std::vector<StampedPose>& poses) {
  const double previous_s =
      poses.empty() ? -std::numeric_limits<double>::infinity() : poses.back().time_s;
  poses.push_back({.time_s = v[0],
                   .position_m = {v[1], v[2], v[3]},
                   .attitude = Eigen::Quaterniond(v[7], v[4], v[5], v[6])});
  return pose_error(poses.back(), previous_s);
}

double parse_number(const std::filesystem::path& file, std::size_t line, const std::string& word) {
  const auto value = parsed<double>(without_plus(word));
  if (!value) throw InputError(file, line, in_quotes(word) + " is not a number");
  return *value;
}

std::vector<StampedPose> read_tum(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<StampedPose> poses;
  std::size_t line_number = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    std::istringstream words{std::string(without_byte_order_mark(line))};
    std::array<double, kColumns> values{};
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
      if (count == 0 && word.starts_with('#')) break;
      if (count < kColumns) values[count] = parse_number(file, line_number, word);
    }
    if (count == 0) continue;
    if (count != kColumns) {
      throw InputError(file, line_number,
                       "has {} numbers; the 8 of t x y z qx qy qz qw are expected", count);
    }
    const std::string error = append_pose(values, poses);
    if (!error.empty()) throw InputError(file, line_number, error);
  }
  return poses;
}

std::vector<StampedPose> read_trajectory_csv(const std::filesystem::path& file) {
  std::vector<StampedPose> poses;
  read_csv(file, columns(), {}, [&](const CsvRow& row) {
    std::array<double, kColumns> values{};
    for (std::size_t i = 0; i < kColumns; ++i) values[i] = row.number(i);
    const std::string error = append_pose(values, poses);
    if (!error.empty()) row.fail(0, ": " + error);
  });
  return poses;
}

// A trajectory.csv has commas; TUM text has none outside its comments.
bool has_commas(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string whole; std::getline(in, whole);) {
    const std::string_view line = without_blanks(without_byte_order_mark(whole));
    if (!line.empty() && line.front() != '#') return line.find(',') != std::string_view::npos;
  }
  return false;
}

void write_poses(const std::filesystem::path& file, const Trajectory& trajectory,
                 std::string_view header, std::string_view separator) {
  TextFile out(file);
  out << header << "\n";
  for (const StampedPose& pose : trajectory.poses()) {
    const Eigen::Vector3d& p = pose.position_m;
    const Eigen::Quaterniond& q = pose.attitude;
    const std::array<double, kColumns> values = {pose.time_s, p.x(), p.y(), p.z(),
                                                 q.x(),       q.y(), q.z(), q.w()};
    for (std::size_t i = 0; i < kColumns; ++i)
      out << values[i] << (i + 1 < kColumns ? separator : "\n");
  }
  out.close();
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& file) {
  require_file(file);
  std::vector<StampedPose> poses = has_commas(file) ? read_trajectory_csv(file) : read_tum(file);
  if (poses.size() < 2)
    throw InputError(file, "a trajectory needs at least two poses; the file has {}", poses.size());
  return Trajectory(std::move(poses));
}

void write_trajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  write_poses(file, trajectory, "t_s,x_m,y_m,z_m,qx,qy,qz,qw", ",");
}

void write_tum(const std::filesystem::path& file, const Trajectory& trajectory) {
  write_poses(file, trajectory, "# t x y z qx qy qz qw", " ");
}

}  // namespace plotscan::scan
