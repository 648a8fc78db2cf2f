// SPDX-License-Identifier: Apache-2.0
#include "scan/field_names.h"

#include <cctype>
#include <map>
#include <string_view>

namespace plotscan::scan {

std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name)
    if (c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::string_view kPrefix = "scalar";
  return plain.starts_with(kPrefix) ? plain.substr(kPrefix.size()) : plain;
}

const std::vector<std::string>& plain_names_of(const std::string& field) {
  static const std::map<std::string, std::vector<std::string>> names = {
      {"intensity", {"intensity", "reflectivity"}},
      {"ring", {"ring", "laserid", "channel"}},
      {"time", {"time", "timestamp", "gpstime", "t"}},
      {"return_number", {"returnnumber"}},
      {"return_count", {"returncount", "numberofreturns"}},
      {"class", {"class", "label"}},
      {"plot", {"plot"}},
      {"plant", {"plant"}}};
  return names.at(field);
}

}  // namespace plotscan::scan
