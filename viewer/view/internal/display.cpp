// SPDX-License-Identifier: Apache-2.0
#include "view/internal/display.h"

#include "core/error.h"

// Last, and in no other file: Xlib's macros (Success, None, Status) break other headers.
#include <X11/Xlib.h>

namespace plotscan::view {

Display::Display() : connection_(XOpenDisplay(nullptr)) {
  if (connection_ == nullptr) {
    throw InputError(
        "there is no X display to draw with; on a machine without a screen: xvfb-run -a plotview "
        "...");
  }
}

Display::~Display() { XCloseDisplay(static_cast<::Display*>(connection_)); }

}  // namespace plotscan::view
