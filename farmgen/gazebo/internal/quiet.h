// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <console_bridge/console.h>
#include <sdf/Console.hh>

// Holds libsdformat's types.
namespace plotscan::gazebo {

// libsdformat's errors come back as values: nothing is printed, neither by itself nor by the URDF
// parser that it tries on what it cannot read.
class Quiet {
 public:
  Quiet() {
    sdf::Console::Instance()->SetQuiet(true);
    console_bridge::noOutputHandler();
  }
  ~Quiet() { console_bridge::restorePreviousOutputHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

}  // namespace plotscan::gazebo
