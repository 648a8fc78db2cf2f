// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plotscan {

// A plot's rectangle in the horizontal plane, in the frame of the farm or the cloud, metres.
struct Box {
  double center_x_m = 0;
  double center_y_m = 0;
  double width_m = 0;
  double length_m = 0;
  double heading_deg = 0;  // of the length axis, counter-clockwise from x, [0, 180)
};

// Standard errors of a box, along its own axes and independent of each other; metres and degrees.
struct BoxError {
  double along_m = 0;   // of the centre, along the length
  double across_m = 0;  // of the centre, along the width
  double width_m = 0;
  double length_m = 0;
  double heading_deg = 0;
};

// A measured height, metres, and how sure it is; NaN where the method does not say.
struct Height {
  double value_m = NAN;
  double standard_error_m = NAN;
  double low95_m = NAN;  // ends of the 95 % interval
  double high95_m = NAN;
};

// One plot as found in, or measured from, a cloud.
struct Plot {
  std::string id;
  int trial = 0;   // from 1; 0 where the field is one trial
  int row = 0;     // of the trial, from 1; 0 where the method has no grid
  int column = 0;  // of the trial, from 1; 0 where the method has no grid
  Box box = {};
  std::optional<BoxError> box_error = {};  // absent where the method does not say, or was given it
  std::size_t points = 0;                  // that the heights were taken from
  std::map<std::string, Height> heights;   // by name, "max", "canopy_p95"; absent: not measured
  std::optional<double> confidence = {};   // that this is a plot, 0 to 1
  std::vector<std::string> flags = {};     // why not to trust the heights; none: they may be
};

// One true plot.
struct TruePlot {
  std::string id;
  int trial = 0;   // from 1; 0 where the farm is one trial
  int row = 0;     // of the trial, from 1; 0 where unknown
  int column = 0;  // of the trial, from 1; 0 where unknown
  Box box = {};
  std::map<std::string, double> heights_m;  // by attribute, "height_max_m", "canopy_p95_m"
};

}  // namespace plotscan
