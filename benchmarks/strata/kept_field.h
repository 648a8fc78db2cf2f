// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "strata/field_plan.h"

namespace plotscan::strata {

// A field on disk: FOLDER/scan/cloud.pcd (positions alone) and, of a farm, FOLDER/farm with its
// truth. FOLDER/plan.json says what it was made from.
struct KeptField {
  std::filesystem::path cloud;
  std::filesystem::path farm;  // "": a field without plots
};

// The field in the folder; it is made and flown if it is not there yet. Throws InputError when the
// folder holds another field, or the farm cannot be made or flown.
KeptField keep_farm(const FieldPlan& plan, const std::filesystem::path& folder, int threads);

// The same for the index-th field without plots that the word draws of a kind (empty_kinds()).
KeptField keep_empty_field(const std::string& word, const std::string& kind, int index,
                           const std::filesystem::path& folder);

}  // namespace plotscan::strata
