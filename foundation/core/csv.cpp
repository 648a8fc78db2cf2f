// SPDX-License-Identifier: Apache-2.0
#include "core/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace plotscan {
namespace {

constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0;;) {
    const auto comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return;
    begin = comma + 1;
  }
}

// For each wanted column its place in the file's header; kAbsent for a missing optional one.
std::vector<std::size_t> places_in_header(const std::filesystem::path& file, std::size_t line,
                                          const std::vector<std::string_view>& header,
                                          const std::vector<std::string>& wanted,
                                          std::size_t required) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), wanted[i]);
    if (found == header.end() && i < required)
      throw InputError(file, line, "column \"" + wanted[i] + "\" is missing");
    places.push_back(found == header.end() ? kAbsent
                                           : static_cast<std::size_t>(found - header.begin()));
  }
  for (const std::string_view name : header) {
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) {
      throw InputError(
          file, line,
          "unknown column \"" + std::string(name) + "\"; known are " + joined(wanted, ","));
    }
  }
  return places;
}

}  // namespace

std::string format_number(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

void CsvRow::fail(std::size_t column, const std::string& what) const {
  throw InputError(file_, line_,
                   columns_[column] + " \"" + std::string(fields_[column]) + "\" " + what);
}

double CsvRow::number(std::size_t column) const {
  const std::string_view field = fields_[column];
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) fail(column, "is not a number");
  if (!std::isfinite(value)) fail(column, "is not finite");
  return value;
}

long long CsvRow::integer(std::size_t column, long long low, long long high) const {
  const std::string_view field = fields_[column];
  long long value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    fail(column, "is not a whole number");
  if (value < low || value > high) {
    fail(column, "is not in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  }
  return value;
}

void read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
              const std::vector<std::string>& optional_columns,
              const std::function<void(const CsvRow&)>& row) {
  const std::string text = read_text(file);
  std::vector<std::string> wanted = columns;
  wanted.insert(wanted.end(), optional_columns.begin(), optional_columns.end());
  std::vector<std::size_t> places;
  std::vector<std::string_view> in_file;
  std::vector<std::string_view> fields(wanted.size());
  std::size_t header_fields = 0;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    split(line, in_file);
    if (header_fields == 0) {
      header_fields = in_file.size();
      places = places_in_header(file, line_number, in_file, wanted, columns.size());
      continue;
    }
    if (in_file.size() != header_fields) {
      throw InputError(file, line_number,
                       "has " + std::to_string(in_file.size()) + " fields; the header names " +
                           std::to_string(header_fields));
    }
    for (std::size_t i = 0; i < places.size(); ++i)
      fields[i] = places[i] == kAbsent ? "" : in_file[places[i]];
    row(CsvRow(file, line_number, wanted, fields));
  }
  if (header_fields == 0)
    throw InputError(file, "is empty; the header line " + joined(columns, ",") + " is expected");
}

}  // namespace plotscan
