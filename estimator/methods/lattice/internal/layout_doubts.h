// SPDX-License-Identifier: Apache-2.0
#pragma once

// What else the plots of a layout may be.

#include <string>
#include <vector>

#include "plots/plot_field.h"

namespace plotscan::methods::lattice {

// What the flags of a trial's plots say of its layout; `stated` is whether the user stated it.
std::vector<std::string> doubts_of(const plots::FieldFit& fit, bool stated);

}  // namespace plotscan::methods::lattice
