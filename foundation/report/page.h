// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace plotscan::report {

// Writes a report: the template that Plotscan ships (report/template.html of the data folder) with
// the document in it (docs/report-format.md), which becomes one HTML file that needs no network.
// Binary values anywhere in the document are stored as base64 outside of it. Texts of the document
// may hold anything: they cannot end the element that they stand in, and the page shows them as
// text. Throws InputError without the template and WriteError when the file cannot be written.
void write_page(const std::filesystem::path& html, nlohmann::json document);

}  // namespace plotscan::report
