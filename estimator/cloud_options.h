// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/cloud_files.h"
#include "core/program.h"

namespace plotscan {

// The command-line arguments that describe a cloud; `run` and `info` share them.
struct CloudArguments {
  CloudFiles cloud;
  std::string units;
  std::vector<double> mount_deg;
};

// Adds CLOUD, --units, --crs and the options for recordings. `arguments` must outlive `command`.
void declare_cloud(CLI::App& command, CloudArguments& arguments);

// Adds --cloud, which is optional, and the same further options.
void declare_shown_cloud(CLI::App& command, CloudArguments& arguments);

// The cloud that the arguments describe; its files are as the user names them.
CloudFiles cloud_of(const CloudArguments& arguments);

}  // namespace plotscan
