// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cloud/field_density.h"
#include "core/cloud_files.h"
#include "scan/cloud_facts.h"

namespace plotscan::inspect {

// What is known of a cloud before anything is measured in it.
struct CloudReport {
  scan::CloudFacts facts;
  cloud::FieldDensity density;              // its field no larger than the cloud
  std::vector<std::string> obstacles = {};  // why it can carry no plots; none: it can
  std::vector<std::string> doubts = {};     // what may keep plots from being found
};

// Reads the cloud once; memory follows the area over which it lies. Throws InputError on a broken
// cloud.
CloudReport inspect_cloud(const CloudFiles& cloud);

// ASPRS' standard classes ("LAS Specification 1.4 - R15", table 17, "ASPRS Standard Point Classes
// (Point Data Record Formats 6-10)"): "ground"; "" for those that are reserved or a user's.
std::string class_name(std::size_t number);

nlohmann::json to_json(const CloudReport& report);

}  // namespace plotscan::inspect
