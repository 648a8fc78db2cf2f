// SPDX-License-Identifier: Apache-2.0
#include "report/page.h"

#include <string_view>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/text.h"
#include "core/text_file.h"
#include "report/internal/packed.h"

namespace plotscan::report {
namespace {

using nlohmann::json;

constexpr std::string_view kPlace = "<!--plotscan-report-->";

// RFC 4648, section 4.
std::string base64(const Bytes& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Moves the binary values out of the document, where their index remains: {"blob": 3}.
void take_blobs(json& value, std::vector<Bytes>& blobs) {
  if (value.is_binary()) {
    blobs.push_back(std::move(value.get_binary()));
    value = {{"blob", blobs.size() - 1}};
  } else if (value.is_structured()) {
    for (json& part : value) take_blobs(part, blobs);
  }
}

// JSON in which nothing can end or begin an element of HTML. Bytes that are no UTF-8 are replaced.
std::string script_safe(const json& document) {
  return with_escapes(document.dump(-1, ' ', true, json::error_handler_t::replace),
                      {{'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}});
}

}  // namespace

void write_page(const std::filesystem::path& html, json document) {
  const std::filesystem::path file = data_folder() / "report" / "template.html";
  const std::string page = read_text(file);
  const std::size_t place = page.find(kPlace);
  if (place == std::string::npos)
    throw InputError(file, "has no place for a report; the template is made in report/");
  document["plotscan"] = version();
  std::vector<Bytes> blobs;
  take_blobs(document, blobs);
  TextFile out(html);
  out << std::string_view(page).substr(0, place)
      << "<script type=\"application/json\" id=\"report\">" << script_safe(document)
      << "</script>\n";
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    out << "<script type=\"text/plain\" id=\"blob-" << i << "\">" << base64(blobs[i])
        << "</script>\n";
  }
  out << std::string_view(page).substr(place + kPlace.size());
  out.close();
}

void require_page(const std::filesystem::path& html,
                  std::span<const std::filesystem::path> inputs) {
  require_apart(html, inputs);
  const std::string extension = lower_extension(html);
  if (extension != ".html" && extension != ".htm") throw InputError(html, "does not end in .html");
}

PageSummary write_field_page(const std::filesystem::path& html, const std::string& kind,
                             const std::string& title, const ShownField& field) {
  json document = {{"kind", kind}, {"title", title}};
  document["fields"] = json::array();
  document["fields"].push_back(packed_field(field));
  write_page(html, std::move(document));
  return {.plots = field.plots.size(),
          .read = field.cloud ? field.cloud->read : 0,
          .shown = field.cloud ? field.cloud->points.size() : 0,
          .notes = field.notes};
}

}  // namespace plotscan::report
