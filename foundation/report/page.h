// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "report/shown_field.h"

namespace plotscan::report {

// Writes a report: the template that Plotscan ships (report/template.html of the data folder) with
// the document in it (docs/report-format.md), which becomes one HTML file that needs no network.
// Binary values anywhere in the document are stored as base64 outside of it. Texts of the document
// may hold anything: they cannot end the element that they stand in, and the page shows them as
// text. Throws InputError without the template and WriteError when the file cannot be written.
void write_page(const std::filesystem::path& html, nlohmann::json document);

// What a page of one field shows.
struct PageSummary {
  std::size_t plots = 0;
  std::uint64_t read = 0;               // points of the cloud
  std::uint64_t shown = 0;              // of these
  std::vector<std::string> notes = {};  // what readers of the page should know
};

// Throws InputError unless the page lies apart from the inputs and its name ends in .html or .htm.
void require_page(const std::filesystem::path& html, std::span<const std::filesystem::path> inputs);

// Writes the page of one field, of a `kind` of docs/report-format.md, as write_page does.
PageSummary write_field_page(const std::filesystem::path& html, const std::string& kind,
                             const std::string& title, const ShownField& field);

}  // namespace plotscan::report
