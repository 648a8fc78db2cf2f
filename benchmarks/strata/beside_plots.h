// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/random.h"
#include "farm/farm.h"
#include "strata/scenery.h"

namespace plotscan::strata {

enum class Beside {
  nothing,
  objects,  // one to three trees, hedges, windrows, cars, sheds, people or patches of weeds
  border,   // another crop without plots, along one side and as far as the cloud goes
};

// The rectangle about all plots, along the first one's heading. World frame, metres.
PlotBox rectangle_about(std::span<const farm::Plot> plots);

// What stands beside plots, 1 to 4 m (objects) or 0.5 to 3 m (border) from the rectangle about
// them. World frame, metres.
std::vector<Thing> draw_beside(Beside beside, std::span<const farm::Plot> plots,
                               RandomStream& random);

// Lifts the returns on the ground below the things to where the things would have returned the
// shots. Nothing else may stand there. What a thing hides behind it stays seen.
void lift(std::span<Eigen::Vector3f> points, const std::vector<Thing>& things,
          RandomStream& random);

}  // namespace plotscan::strata
