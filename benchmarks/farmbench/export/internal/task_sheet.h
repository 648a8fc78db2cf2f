// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace plotscan::farmbench {

// TASK.md of an export: the given files, the task and how to submit results. `task` is its
// task.json (docs/submissions.md).
std::string task_sheet(const nlohmann::json& task);

}  // namespace plotscan::farmbench
