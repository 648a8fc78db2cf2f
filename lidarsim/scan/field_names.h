// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plotscan::scan {

// A field's name in lower case, without underscores and CloudCompare's "scalar_": "ReturnNumber"
// and "scalar_return_number" are "returnnumber".
std::string plain_name(const std::string& name);

// The plain names by which programs and drivers call a field of LabelledPoint, the most usual first
// (docs/formats.md). `field` is its name in our files.
const std::vector<std::string>& plain_names_of(const std::string& field);

}  // namespace plotscan::scan
