// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// What --seed means to the commands that make tables.
inline constexpr const char* kTableSeed = "seed of the bootstrap that makes the table's intervals";

}  // namespace plotscan
