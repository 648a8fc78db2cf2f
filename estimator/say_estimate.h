// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "core/program.h"
#include "estimate/estimate.h"

namespace plotscan {

// Prints an estimate at the terminal for `estimator run`; `summary` is its height_summary.
void say_estimate(const Program& program, const estimate::Estimate& estimate,
                  const nlohmann::json& summary);

}  // namespace plotscan
