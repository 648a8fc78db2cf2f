// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::view {

// A connection to the X display, held while a picture is drawn: VTK ends the whole program where no
// display answers, and an Xvfb whose last client leaves starts anew under the next one's feet.
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
