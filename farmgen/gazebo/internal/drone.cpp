// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "core/angle.h"
#include "gazebo/internal/world_file.h"
#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace {

using sdfxml::sdf_numbers;
using sdfxml::XmlFile;

// The VLP-16 as lidarsim has it (models/sensors/vlp16.yaml): at 10 Hz its 18,084 firing sequences a
// second are 1,808 azimuths a turn.
constexpr int kAzimuths = 1808;
constexpr double kElevation_rad = radians(15);
constexpr double kMinRange_m = 0.4;
constexpr double kMaxRange_m = 100;
constexpr double kRangeStep_m = 0.002;
constexpr double kRangeNoise_m = 0.03;

class Drone {
 public:
  Drone(XmlFile& xml, Gazebo gazebo, Lidar lidar) : xml_(xml), gazebo_(gazebo), lidar_(lidar) {}

  void write(bool gps) {
    xml_.open("link", "base_link");
    if (gazebo_ == Gazebo::classic) write_kinematics();
    write_body();
    write_lidar();
    open_sensor("imu", "imu", "100", "imu");
    xml_.close();
    if (gps) {
      open_sensor("gps", gazebo_ == Gazebo::classic ? "gps" : "navsat", "5", "navsat");
      xml_.close();
    }
    xml_.close();
  }

  std::uint64_t visuals() const { return visuals_; }

 private:
  // What Gazebo Classic needs for a model that is not static: a mass, and no gravity.
  void write_kinematics() {
    xml_.text("gravity", "false");
    xml_.text("kinematic", "true");
    xml_.open("inertial");
    xml_.text("mass", "1.477");  // hector_quadrotor, as lidarsim's drone
    xml_.texts("inertia", {{"ixx", "0.01152"},
                           {"ixy", "0"},
                           {"ixz", "0"},
                           {"iyy", "0.01152"},
                           {"iyz", "0"},
                           {"izz", "0.0218"}});
    xml_.close();
  }

  void write_body() {
    const Eigen::Vector3f dark(0.15F, 0.15F, 0.17F);
    const Eigen::Vector3f grey(0.5F, 0.5F, 0.52F);
    write_cylinder("lidar_housing", "0 0 0 0 1.5707963267948966 0", 0.0517, 0.0717, grey);
    write_box("body", "0 0 0.1 0 0 0", "0.16 0.16 0.06", dark);
    write_box("arm_1", "0 0 0.1 0 0 0.7853981633974483", "0.46 0.025 0.02", dark);
    write_box("arm_2", "0 0 0.1 0 0 2.356194490192345", "0.46 0.025 0.02", dark);
    const double rotor = 0.23 * std::numbers::sqrt2 / 2;
    int number = 0;
    for (const double x : {-rotor, rotor}) {
      for (const double y : {-rotor, rotor}) {
        ++number;
        write_cylinder("rotor_" + std::to_string(number), sdf_numbers({x, y, 0.12, 0, 0, 0}), 0.1,
                       0.006, number > 2 ? Eigen::Vector3f(0.8F, 0.2F, 0.1F) : grey);
      }
    }
  }

  void open_visual(const std::string& name, const std::string& pose) {
    ++visuals_;
    xml_.open("visual", name);
    xml_.text("pose", pose);
    xml_.open("geometry");
  }

  void close_visual(const Eigen::Vector3f& colour) {
    xml_.close();
    open_material(xml_, colour);
    xml_.close();
    write_class(xml_, farm::SurfaceClass::other);
    xml_.close();
  }

  void write_box(const std::string& name, const std::string& pose, const std::string& size,
                 const Eigen::Vector3f& colour) {
    open_visual(name, pose);
    xml_.texts("box", {{"size", size}});
    close_visual(colour);
  }

  void write_cylinder(const std::string& name, const std::string& pose, double radius,
                      double length, const Eigen::Vector3f& colour) {
    open_visual(name, pose);
    xml_.texts("cylinder", {{"radius", sdf_numbers({radius})}, {"length", sdf_numbers({length})}});
    close_visual(colour);
  }

  void open_sensor(const std::string& name, const std::string& type, const std::string& rate_hz,
                   const std::string& topic) {
    xml_.open("sensor", name);
    xml_.attribute("type", type);
    xml_.text("always_on", "true");
    xml_.text("update_rate", rate_hz);
    xml_.text("topic", topic);
  }

  void write_angles(const char* axis, int samples, double min_rad, double max_rad) {
    xml_.texts(axis, {{"samples", std::to_string(samples)},
                      {"resolution", "1"},
                      {"min_angle", sdf_numbers({min_rad})},
                      {"max_angle", sdf_numbers({max_rad})}});
  }

  void write_lidar() {
    const bool classic = gazebo_ == Gazebo::classic;
    // Gazebo Classic's "ray" meets collisions; "gpu_ray" sees what is drawn, as "gpu_lidar" does in
    // Gazebo Sim.
    const char* classic_type = lidar_ == Lidar::cpu ? "ray" : "gpu_ray";
    open_sensor("vlp16", classic ? classic_type : "gpu_lidar", "10", "vlp16");
    xml_.text("pose", "0 0 0 0 1.5707963267948966 0");
    xml_.text("visualize", "false");
    xml_.open(classic ? "ray" : "lidar");
    xml_.open("scan");
    const double turn = 2 * kPi;
    write_angles("horizontal", kAzimuths, -turn / 2, turn / 2 - turn / kAzimuths);
    write_angles("vertical", 16, -kElevation_rad, kElevation_rad);
    xml_.close();
    xml_.texts("range", {{"min", sdf_numbers({kMinRange_m})},
                         {"max", sdf_numbers({kMaxRange_m})},
                         {"resolution", sdf_numbers({kRangeStep_m})}});
    xml_.texts("noise",
               {{"type", "gaussian"}, {"mean", "0"}, {"stddev", sdf_numbers({kRangeNoise_m})}});
    xml_.close();
    xml_.close();
  }

  XmlFile& xml_;
  Gazebo gazebo_;
  Lidar lidar_;
  std::uint64_t visuals_ = 0;
};

}  // namespace

EntityCounts write_drone_model(const ModelFolder& models, Lidar lidar, bool gps) {
  std::filesystem::create_directories(models.path / kDroneModel);
  sdfxml::XmlFile xml =
      begin_model(models, kDroneModel, "A quadrotor with a VLP-16, moved by fly_drone.sh",
                  models.gazebo == Gazebo::sim);
  Drone drone(xml, models.gazebo, lidar);
  drone.write(gps);
  end_model(xml);
  return {.models = 1, .links = 1, .visuals = drone.visuals()};
}

}  // namespace plotscan::gazebo
