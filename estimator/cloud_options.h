// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/cloud_files.h"
#include "core/program.h"

namespace plotscan {

// A cloud on the command line: what run and info are told of it alike.
struct CloudArguments {
  CloudFiles cloud;
  std::string units;
  std::vector<double> mount_deg;
};

// Adds CLOUD, --units, --crs and what tells of recordings. The arguments outlive the command.
void declare_cloud(CLI::App& command, CloudArguments& arguments);

// Adds --cloud and the same options, of a cloud that may be left out.
void declare_shown_cloud(CLI::App& command, CloudArguments& arguments);

// The cloud as told; its files are as the user names them.
CloudFiles cloud_of(const CloudArguments& arguments);

}  // namespace plotscan
