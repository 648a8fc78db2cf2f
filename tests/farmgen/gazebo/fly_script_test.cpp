// SPDX-License-Identifier: Apache-2.0
// fly_drone.sh, run against a fake Gazebo on PATH.
#include "gazebo/fly_script.h"

#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "farmgen/gazebo/export_example.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/error.h"
#include "scan/trajectory.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A Gazebo Sim that notes what it is asked; steps run at once.
constexpr const char* kFakeSim = R"sh(#!/bin/sh
here=$(dirname "$0")
case "$1" in
  sim) exit 0 ;;
  topic)
    printf 'sim_time {\n  sec: 1\n}\niterations: %s\npaused: true\n' "$(cat "$here/iterations")" ;;
  service)
    echo "$*" >> "$here/log.txt"
    case "$*" in *multi_step*)
      steps=${*##*multi_step: }
      echo $(($(cat "$here/iterations") + steps)) > "$here/iterations" ;;
    esac
    echo 'data: true' ;;
esac
)sh";

constexpr const char* kFakeClassic = R"sh(#!/bin/sh
here=$(dirname "$0")
case "$1" in
  stats)
    echo '# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)'
    echo "1.00, $(awk '{ print $1 / 1000 }' "$here/iterations"), 5.0, T" ;;
  *)
    echo "$*" >> "$here/log.txt"
    case "$*" in world*" -m "*)
      steps=${*##*-m }
      echo $(($(cat "$here/iterations") + steps)) > "$here/iterations" ;;
    esac ;;
esac
)sh";

class FlyScript : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<scan::StampedPose> poses;
    for (int i = 0; i < 12; ++i) {
      const double angle = 0.9 * i;
      Eigen::Quaterniond attitude(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.2 * i - 1, Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(-0.1 * i, Eigen::Vector3d::UnitX()));
      if (i % 3 == 0) attitude.coeffs() *= -1;  // the same attitude
      poses.push_back({.time_s = 0.5 + 0.07 * i + 0.01 * (i % 2),
                       .position_m = {1.5 * i, -0.3 * i * i, 8 + 1e-5 * i},
                       .attitude = attitude});
    }
    trajectory_ = std::make_unique<scan::Trajectory>(poses);
    scan::write_trajectory(folder_.path() / "trajectory.csv", *trajectory_);
    folder_.write("bin/iterations", "7\n");
  }

  void install(const std::string& program, const char* fake) const {
    const fs::path file = folder_.write("bin/" + program, fake);
    fs::permissions(file, fs::perms::owner_all);
  }

  int run(Gazebo gazebo, const std::string& arguments) const {
    write_fly_script(folder_.path() / "fly_drone.sh", "some.farm-1", gazebo);
    const std::string command = "cd '" + folder_.path().string() +
                                "' && PATH=\"$PWD/bin:$PATH\" ./fly_drone.sh " + arguments +
                                " >out.txt 2>err.txt </dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::vector<std::string> log() const {
    std::vector<std::string> lines;
    std::istringstream in(read_text(folder_.path() / "bin/log.txt"));
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  std::string error() const { return read_text(folder_.path() / "err.txt"); }

  // All numbers after the first `skip` characters of the line that pattern matches.
  static std::vector<double> numbers(const std::string& line, const std::string& pattern) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(line, match, std::regex(pattern))) << line;
    std::vector<double> values;
    for (std::size_t i = 1; i < match.size(); ++i) values.push_back(std::stod(match[i]));
    return values;
  }

  void expect_pose(double time_s, const Eigen::Vector3d& position,
                   const Eigen::Quaterniond& attitude) const {
    const Eigen::Isometry3d expected = trajectory_->world_from_body(time_s);
    EXPECT_LT((position - expected.translation()).norm(), 1e-8) << time_s;
    EXPECT_LT(attitude.normalized().angularDistance(Eigen::Quaterniond(expected.linear())), 1e-7)
        << time_s;
  }

  testing::TemporaryFolder folder_;
  std::unique_ptr<scan::Trajectory> trajectory_;
};

const std::string kNumber = "(-?[0-9.]+)";

TEST_F(FlyScript, GazeboSimIsSentThePosesOfTheTrajectory) {
  install("gz", kFakeSim);
  ASSERT_EQ(run(Gazebo::sim, "trajectory.csv"), 0) << error();
  const std::vector<std::string> lines = log();
  EXPECT_THAT(lines.front(),
              HasSubstr("/world/some.farm-1/control --reqtype gz.msgs.WorldControl"));
  int pose = 0;
  for (std::size_t i = 1; i + 1 < lines.size(); i += 2, ++pose) {
    EXPECT_THAT(lines[i], HasSubstr("-s /world/some.farm-1/set_pose --reqtype gz.msgs.Pose "
                                    "--reptype gz.msgs.Boolean"));
    const auto v =
        numbers(lines[i], "name: \"drone\", position: \\{x: " + kNumber + ", y: " + kNumber +
                              ", z: " + kNumber + "\\}, orientation: \\{x: " + kNumber +
                              ", y: " + kNumber + ", z: " + kNumber + ", w: " + kNumber + "\\}");
    ASSERT_EQ(v.size(), 7u);
    expect_pose(trajectory_->start_s() + 0.1 * pose, {v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]});
    EXPECT_THAT(lines[i + 1], HasSubstr("pause: true, multi_step: 100")) << "one turn of the lidar";
  }
  EXPECT_EQ(pose, 1 + std::floor((trajectory_->end_s() - trajectory_->start_s()) / 0.1 + 1e-9));
}

TEST_F(FlyScript, FortressIsCalledByItsOwnNames) {
  install("ign", kFakeSim);
  install("gz", "#!/bin/sh\nexit 1\n");  // Gazebo Classic's
  ASSERT_EQ(run(Gazebo::sim, "-s 0.02 -b 0.6 -e 0.63 trajectory.csv"), 0) << error();
  const std::vector<std::string> lines = log();
  ASSERT_EQ(lines.size(), 1 + 2 * 2u);
  EXPECT_THAT(lines[1], HasSubstr("--reqtype ignition.msgs.Pose --reptype ignition.msgs.Boolean"));
  EXPECT_THAT(lines[2], HasSubstr("multi_step: 20"));
}

TEST_F(FlyScript, GazeboClassicIsSentThePosesOfTheTrajectory) {
  install("gz", kFakeClassic);
  ASSERT_EQ(run(Gazebo::classic, "-s 0.05 trajectory.csv"), 0) << error();
  const std::vector<std::string> lines = log();
  EXPECT_EQ(lines.front(), "world -w some.farm-1 -p 1");
  int pose = 0;
  for (std::size_t i = 1; i + 1 < lines.size(); i += 2, ++pose) {
    const auto v = numbers(lines[i], "model -w some.farm-1 -m drone -x " + kNumber + " -y " +
                                         kNumber + " -z " + kNumber + " -R " + kNumber + " -P " +
                                         kNumber + " -Y " + kNumber);
    ASSERT_EQ(v.size(), 6u);
    const Eigen::Quaterniond attitude(Eigen::AngleAxisd(v[5], Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(v[4], Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(v[3], Eigen::Vector3d::UnitX()));
    expect_pose(trajectory_->start_s() + 0.05 * pose, {v[0], v[1], v[2]}, attitude);
    EXPECT_EQ(lines[i + 1], "world -w some.farm-1 -m 50");
  }
  EXPECT_GT(pose, 10);
}

TEST_F(FlyScript, RefusesWhatIsNoTrajectory) {
  install("gz", kFakeSim);
  folder_.write("other.csv", "a,b\n1,2\n");
  folder_.write("back.csv", "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n1,0,0,0,0,0,0,1\n");
  folder_.write("short.csv", "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n");
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "usage:"},
           {"none.csv", "cannot be read"},
           {"other.csv", "is not a trajectory.csv"},
           {"back.csv", "line 3: times do not increase"},
           {"short.csv", "fewer than two poses"},
           {"-s 0 trajectory.csv", "at least 0.001 s"},
           {"-x trajectory.csv", "usage:"}}) {
    EXPECT_EQ(run(Gazebo::sim, arguments), 2) << arguments;
    EXPECT_THAT(error(), HasSubstr(message)) << arguments;
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "bin/log.txt")) << "Gazebo was not asked";
}

TEST_F(FlyScript, SaysWhenTheWorldIsNotOpen) {
  install("gz", "#!/bin/sh\n[ \"$1\" = sim ] || echo 'Service call timed out'\n");
  EXPECT_EQ(run(Gazebo::sim, "trajectory.csv"), 1);
  EXPECT_THAT(error(), HasSubstr("/world/some.farm-1/control does not answer; is the world open?"));
}

}  // namespace
}  // namespace plotscan::gazebo
