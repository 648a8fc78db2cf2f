// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "gazebo/read_world.h"
#include "temporary_folder.h"
#include "world_text.h"

namespace plotscan::gazebo {

inline const std::string kMesh = "<mesh><uri>mesh.obj</uri></mesh>";
inline const std::string kTriangle = "o near\nv 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n";

// Worlds and models in a folder of their own.
class ReadWorld : public ::testing::Test {
 protected:
  StaticWorld read(const std::string& content, const ReadWorldOptions& options = {}) const {
    return read_world(folder_.write("by_hand.sdf", testing::world_text(content)), options);
  }
  std::string refusal(const std::string& content) const {
    return testing::message_of<InputError>([&] { read(content); });
  }
  void write_model(const std::string& folder, const std::string& sdf) const {
    folder_.write(folder + "/model.config",
                  "<model><name>m</name><sdf version='1.9'>model.sdf</sdf></model>");
    folder_.write(folder + "/model.sdf", "<sdf version='1.9'>" + sdf + "</sdf>");
  }

  testing::TemporaryFolder folder_;
};

}  // namespace plotscan::gazebo
