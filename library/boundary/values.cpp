// SPDX-License-Identifier: Apache-2.0
#include "boundary/values.h"

#include <algorithm>
#include <thread>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"

namespace plotscan::boundary {

PlotBox inner(const Box& box) {
  return {.center = {box.center_x_m, box.center_y_m},
          .width_m = box.width_m,
          .length_m = box.length_m,
          .heading_rad = box.heading_deg * kDegrees};
}

Box outer(const PlotBox& box) {
  return {.center_x_m = box.center.x(),
          .center_y_m = box.center.y(),
          .width_m = box.width_m,
          .length_m = box.length_m,
          .heading_deg = wrap_heading(box.heading_rad) / kDegrees};
}

PlotBoxError inner(const BoxError& error) {
  return {.along_m = error.along_m,
          .across_m = error.across_m,
          .width_m = error.width_m,
          .length_m = error.length_m,
          .heading_rad = radians(error.heading_deg)};
}

BoxError outer(const PlotBoxError& error) {
  return {.along_m = error.along_m,
          .across_m = error.across_m,
          .width_m = error.width_m,
          .length_m = error.length_m,
          .heading_deg = error.heading_rad / kDegrees};
}

int threads_of(int threads) {
  if (threads < 0)
    throw InputError(
        fmt::format("threads is {}; it is 0 (one for each processor) or more", threads));
  if (threads != 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace plotscan::boundary
