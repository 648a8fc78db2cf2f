// SPDX-License-Identifier: Apache-2.0
// A plugin of a CPU lidar in Gazebo 11. It writes beside the world (the folder that gzserver was
// started in)
// - models.txt: the names of the world's models, at the first scan;
// - scans.bin: of each stamp the last scan, as doubles: stamp, pose (x y z, qx qy qz qw), ranges,
// then intensities, ring by
//   ring. The lidar goes on measuring at one stamp while the world is paused.
// Gazebo's own messages come too late, and too many at once, where the machine is busy.
#include <cstdio>
#include <fstream>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo {

class Recorder : public SensorPlugin {
 public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr) override {
    lidar_ = std::dynamic_pointer_cast<sensors::RaySensor>(sensor);
    link_ = physics::get_world()->EntityByName(lidar_->ParentName());
    updated_ = lidar_->ConnectUpdated([this] { keep(); });
    lidar_->SetActive(true);
  }

 private:
  void keep() {
    const double stamp_s = lidar_->LastMeasurementTime().Double();
    if (scan_.empty()) list_models();
    if (!scan_.empty() && scan_[0] != stamp_s) write();
    const ignition::math::Pose3d pose = lidar_->Pose() + link_->WorldPose();
    scan_ = {stamp_s,        pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(),
             pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), pose.Rot().W()};
    const int beams = lidar_->RangeCount() * lidar_->VerticalRangeCount();
    for (int i = 0; i < beams; ++i) scan_.push_back(lidar_->LaserShape()->GetRange(i));
    for (int i = 0; i < beams; ++i) scan_.push_back(lidar_->LaserShape()->GetRetro(i));
  }

  void write() {
    std::ofstream out("scans.bin", std::ios::binary | std::ios::app);
    out.write(reinterpret_cast<const char*>(scan_.data()),
              static_cast<std::streamsize>(scan_.size() * sizeof(double)));
  }

  static void list_models() {
    {
      std::ofstream out("models.part");
      for (const auto& model : physics::get_world()->Models()) out << model->GetName() << "\n";
    }
    std::rename("models.part", "models.txt");
  }

  sensors::RaySensorPtr lidar_;
  physics::EntityPtr link_;
  event::ConnectionPtr updated_;
  std::vector<double> scan_;
};

GZ_REGISTER_SENSOR_PLUGIN(Recorder)

}  // namespace gazebo
