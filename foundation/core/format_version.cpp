// SPDX-License-Identifier: Apache-2.0
#include "core/format_version.h"

#include "core/error.h"
#include "core/manifest.h"

namespace plotscan {

std::string format_error(const nlohmann::json& format) {
  const bool is_number = format.is_number_unsigned();
  if (is_number && format.get<std::uint64_t>() <= kFormat) return "";
  const std::string what = is_number ? "is of format " + format.dump() + ", which is newer"
                                     : "has a format that is no whole number";
  return what + "; this plotscan, " + version() + ", reads formats up to " +
         std::to_string(kFormat);
}

void require_known_format(const nlohmann::json& document, const std::filesystem::path& file) {
  if (!document.is_object() || !document.contains("format")) return;
  const std::string error = format_error(document["format"]);
  if (!error.empty()) throw InputError(file, error);
}

}  // namespace plotscan
