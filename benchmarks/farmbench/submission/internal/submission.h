// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "farmbench/entry/entered_plots.h"
#include "farmbench/entry/problems.h"
#include "farmbench/suite_choice.h"

namespace plotscan::farmbench {

// A folder that somebody hands in (docs/submissions.md).
struct Submission {
  std::string method;
  std::string program_sha256 = {};                 // "" where it says nothing of its program
  nlohmann::json task = nlohmann::json();          // its copy of task.json, null without one
  std::map<std::string, EnteredPlots> fields;      // by code; those that have a file
  std::map<std::string, std::string> file_sha256;  // by code
  // Whether boxes were given, or any field's plots stand in given ones.
  bool in_given_boxes() const;
};

// Reads a submission for the fields. Throws InputError on a folder that is none; all else that is
// wrong goes to `problems`.
Submission read_submission(const std::filesystem::path& folder,
                           const std::vector<BlindField>& fields, Problems& problems);

}  // namespace plotscan::farmbench
