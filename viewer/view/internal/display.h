// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::view {

// A connection to the X display, held while a picture is drawn: VTK ends the whole program if no
// display answers, and an Xvfb restarts when its last client leaves, which breaks the next client.
class Display {
 public:
  // Throws InputError when no display answers.
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  void* connection_;
};

}  // namespace plotscan::view
