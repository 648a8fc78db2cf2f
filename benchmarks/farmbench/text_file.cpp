// SPDX-License-Identifier: Apache-2.0
#include "farmbench/text_file.h"

#include "core/json_text.h"
#include "core/output_file.h"
#include "core/text_file.h"

namespace plotscan::farmbench {

void write_text(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path, true);
  write_text_file(file.path(), text);
  file.commit();
}

void write_json(const std::filesystem::path& path, const nlohmann::json& document) {
  write_text(path, json_lines(document));
}

}  // namespace plotscan::farmbench
