// SPDX-License-Identifier: Apache-2.0
// fly_drone.sh, run against a fake Gazebo on PATH.
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tinyxml2.h>

#include "core/error.h"
#include "farmgen/gazebo/export_example.h"
#include "gazebo/internal/world_file.h"
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

// A Gazebo Classic with one model, whose clock runs 530 ms further each time it is read unless the
// world is paused.
constexpr const char* kFakeClassic = R"sh(#!/bin/sh
here=$(dirname "$0")
echo "$*" >> "$here/log.txt"
case "$*" in
  "topic -e"*)
    now=$(cat "$here/now_ms")
    printf 'sim_time { sec: %s nsec: %s000000 } pause_time { sec: 7 nsec: 0 } paused: true\n' \
      $((now / 1000)) $((now % 1000))
    [ -e "$here/paused" ] || echo $((now + 530)) > "$here/now_ms" ;;
  "topic -p"*)
    while [ $# -gt 1 ]; do shift; done
    cp "$1" "$here/factory.txt"
    touch "$here/stands" ;;
  "world "*" -p 1") touch "$here/paused" ;;
  "world "*" -m "*) echo $(($(cat "$here/now_ms") + ${*##*-m })) > "$here/now_ms" ;;
  "world "*" -p 0") [ -e "$here/stuck" ] || rm "$here/paused" ;;
  "model "*" -d") [ -e "$here/stays" ] || rm "$here/stands" ;;
  "model "*" -i")
    [ ! -e "$here/mute" ] || exit 0
    if [ -e "$here/stands" ]; then echo 'name: "drone"'; else echo 'Unable to get info'; fi ;;
esac
)sh";

// Quotes and backslashes are what its way to Gazebo could break.
constexpr const char* kDroneText =
    "<?xml version=\"1.0\"?>\n<sdf version=\"1.6\">\n  <model name=\"drone\">\n"
    "    <static>false</static>\n    <link name=\"base_link\">\n"
    "      <sensor name=\"vlp16\" type=\"gpu_ray\"/>\n"
    "      <plugin name='it&apos;s' filename=\"a\\b.so\"/>\n    </link>\n  </model>\n</sdf>\n";

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
    folder_.write("bin/now_ms", "4000\n");
    folder_.write("bin/stands", "");
    folder_.write("models/drone/model.sdf", kDroneText);
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

struct Waypoint {
  double time_s;
  Eigen::Vector3d position;
  Eigen::Quaterniond attitude;
};

Waypoint waypoint_of(const tinyxml2::XMLElement& element) {
  std::istringstream text(element.FirstChildElement("pose")->GetText());
  double x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0;
  text >> x >> y >> z >> roll >> pitch >> yaw;
  EXPECT_TRUE(text);
  return {.time_s = std::stod(element.FirstChildElement("time")->GetText()),
          .position = {x, y, z},
          .attitude = Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))};
}

// The string of the message's one field, read as protobuf's text format has it: quoted parts side
// by side are one string, a backslash stands before a quote or a backslash.
std::string string_of_factory(const std::string& message) {
  EXPECT_EQ(message.substr(0, 4), "sdf:");
  std::string text;
  bool inside = false;
  for (std::size_t i = 4; i < message.size(); ++i) {
    if (inside && message[i] == '\\') {
      text += message.at(++i);
    } else if (message[i] == '\'') {
      inside = !inside;
    } else if (inside) {
      EXPECT_NE(message[i], '\n') << "a string ends in its line";
      text += message[i];
    }
  }
  EXPECT_FALSE(inside);
  return text;
}

TEST_F(FlyScript, GazeboClassicGetsTheDroneBackAsAnActorThatHoldsEachPose) {
  install("gz", kFakeClassic);
  ASSERT_EQ(run(Gazebo::classic, "-s 0.2 trajectory.csv"), 0) << error();
  tinyxml2::XMLDocument document;
  const std::string sdf = string_of_factory(read_text(folder_.path() / "bin/factory.txt"));
  ASSERT_EQ(document.Parse(sdf.c_str()), tinyxml2::XML_SUCCESS) << sdf;
  const tinyxml2::XMLElement* actor = document.RootElement()->FirstChildElement("actor");
  ASSERT_NE(actor, nullptr);
  EXPECT_STREQ(actor->Attribute("name"), "drone");
  EXPECT_EQ(actor->FirstChildElement("static"), nullptr);
  const tinyxml2::XMLElement* link = actor->FirstChildElement("link");
  ASSERT_NE(link, nullptr);
  EXPECT_STREQ(link->FirstChildElement("sensor")->Attribute("type"), "gpu_ray");
  EXPECT_STREQ(link->FirstChildElement("plugin")->Attribute("name"), "it's");
  EXPECT_STREQ(link->FirstChildElement("plugin")->Attribute("filename"), "a\\b.so");

  const tinyxml2::XMLElement* script = actor->FirstChildElement("script");
  ASSERT_NE(script, nullptr);
  EXPECT_STREQ(script->FirstChildElement("loop")->GetText(), "false");
  std::vector<Waypoint> waypoints;
  for (auto* each = script->FirstChildElement("trajectory")->FirstChildElement("waypoint");
       each != nullptr; each = each->NextSiblingElement("waypoint")) {
    waypoints.push_back(waypoint_of(*each));
    if (waypoints.size() > 1) {
      EXPECT_GT(waypoints.back().time_s, waypoints[waypoints.size() - 2].time_s);
    }
  }
  const std::size_t poses =
      1 + static_cast<std::size_t>((trajectory_->end_s() - trajectory_->start_s()) / 0.2 + 1e-9);
  ASSERT_EQ(waypoints.size(), 4 * poses);
  for (std::size_t i = 0; i < poses; ++i) {
    const double step = 0.2 * static_cast<double>(i);
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
      expect_pose(trajectory_->start_s() + step, waypoints[k].position, waypoints[k].attitude);
    // The lidar measures at 1 + step; the spline is flat between the inner waypoints.
    EXPECT_LT(waypoints[4 * i + 1].time_s, 1 + step - 0.2 * 0.39);
    EXPECT_GT(waypoints[4 * i + 2].time_s, 1 + step + 0.2 * 0.58);
  }
}

TEST_F(FlyScript, GazeboClassicIsPausedWhileTheDroneIsReplaced) {
  install("gz", kFakeClassic);
  ASSERT_EQ(run(Gazebo::classic, "trajectory.csv"), 0) << error();
  std::vector<std::string> acts;
  for (const std::string& line : log()) {
    if (line.find(" -e ") == std::string::npos && line.find(" -i") == std::string::npos)
      acts.push_back(line.substr(0, line.find(" -f ")));
  }
  EXPECT_THAT(acts, ::testing::ElementsAre(
                        "world -w some.farm-1 -p 1", "world -w some.farm-1 -m 70",
                        "model -w some.farm-1 -m drone -d", "topic -p /gazebo/some.farm-1/factory",
                        "world -w some.farm-1 -p 0"));
  // Read at 4.0 s before the pause and at 4.53 s in it; the drone stands for a second.
  EXPECT_EQ(read_text(folder_.path() / "out.txt"),
            "8 poses, from 5.600 s to 6.300 s of simulated time\n");
  EXPECT_GE(std::stoi(read_text(folder_.path() / "bin/now_ms")), 6300) << "waits for the end";
}

TEST_F(FlyScript, GazeboClassicWithoutADroneGetsOne) {
  install("gz", kFakeClassic);
  fs::remove(folder_.path() / "bin/stands");
  ASSERT_EQ(run(Gazebo::classic, "trajectory.csv"), 0) << error();
  EXPECT_TRUE(fs::exists(folder_.path() / "bin/factory.txt"));
}

TEST_F(FlyScript, SaysWhatGazeboClassicDoesNotDo) {
  install("gz", kFakeClassic);
  folder_.write("bin/stays", "");
  EXPECT_EQ(run(Gazebo::classic, "trajectory.csv"), 1);
  EXPECT_THAT(error(), HasSubstr("the drone cannot be taken out of the world"));
  fs::remove(folder_.path() / "bin/stays");
  folder_.write("bin/stuck", "");
  EXPECT_EQ(run(Gazebo::classic, "trajectory.csv"), 1);
  EXPECT_THAT(error(), HasSubstr("Gazebo stands still at 4.600000000 s; is it paused?"));
  fs::remove(folder_.path() / "bin/stuck");
  fs::remove(folder_.path() / "bin/paused");
  folder_.write("bin/mute", "");
  EXPECT_EQ(run(Gazebo::classic, "trajectory.csv"), 1);
  EXPECT_THAT(error(), HasSubstr("does not tell whether the drone is in it"));
  install("gz", "#!/bin/sh\necho 'An instance of Gazebo is not running.'\n");
  EXPECT_EQ(run(Gazebo::classic, "trajectory.csv"), 1);
  EXPECT_THAT(error(), HasSubstr("the world some.farm-1 does not answer; is it open?"));
  EXPECT_EQ(run(Gazebo::classic, "-s 0.05 trajectory.csv"), 2);
  EXPECT_THAT(error(), HasSubstr("-s 0.05: at least 0.1 s is expected"));
  fs::remove(folder_.path() / "models/drone/model.sdf");
  EXPECT_EQ(run(Gazebo::classic, "trajectory.csv"), 2);
  EXPECT_THAT(error(), HasSubstr("models/drone/model.sdf: cannot be read"));
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
           {"-b 0.9 -e 0.6 trajectory.csv", "trajectory.csv: lasts from 0.5 to 1.28 s; -b and -e"},
           {"-b 0.4 trajectory.csv", "lasts from 0.5 to 1.28 s"},
           {"-e 2 trajectory.csv", "lasts from 0.5 to 1.28 s"},
           {"-b 1s trajectory.csv", "lasts from 0.5 to 1.28 s"},
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
