// SPDX-License-Identifier: Apache-2.0
#include "core/csv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/number_text.h"
#include "core/parse.h"
#include "core/printable.h"
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

// The whole text of a table. It must be UTF-8, since its values go into JSON.
std::string table_text(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  require_utf8(text, file);
  return std::string(without_byte_order_mark(text));
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
  for (auto name = header.begin(); name != header.end(); ++name) {
    if (std::find(header.begin(), name, *name) != name)
      throw InputError(file, line, "column \"" + std::string(*name) + "\" is there twice");
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
  return std::string(std::string_view(NumberText(value)));
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
  const auto value = parsed<double>(fields_[column]);
  if (!value) fail(column, "is not a number");
  if (!std::isfinite(*value)) fail(column, "is not finite");
  return *value;
}

long long CsvRow::integer(std::size_t column, long long low, long long high) const {
  const auto value = parsed<long long>(fields_[column]);
  if (!value) fail(column, "is not a whole number");
  if (*value < low || *value > high) {
    fail(column, "is not in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  }
  return *value;
}

void read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
              const std::vector<std::string>& optional_columns,
              const std::function<void(const CsvRow&)>& row) {
  const std::string text = table_text(file);
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

namespace {

// Splits the whole text of a table into records, and these into fields.
class TableText {
 public:
  TableText(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {
    const std::size_t begin = std::min(text_.find_first_not_of(" \r\n"), text_.size());
    const std::string_view header = text_.substr(begin, text_.find('\n', begin) - begin);
    for (const char separator : {'\t', ';', ','}) {
      if (header.find(separator) != std::string_view::npos) separator_ = separator;
    }
  }

  // The next record; nothing at the end of the text.
  std::optional<CsvTable::Line> next() {
    while (at_ < text_.size()) {
      CsvTable::Line record{.line = line_, .fields = {field()}};
      while (at_ < text_.size() && text_[at_] == separator_) {
        ++at_;
        record.fields.push_back(field());
      }
      ++at_;
      ++line_;
      if (record.fields.size() > 1 || !record.fields.front().empty()) return record;
    }
    return std::nullopt;
  }

 private:
  // The field from at_ to the next separator or line end.
  std::string field() {
    const std::size_t start = text_.find_first_not_of(" \r", at_);
    if (start != std::string_view::npos && text_[start] == '"') return quoted_field(start + 1);
    const std::size_t end = text_.find_first_of(std::string{separator_, '\n'}, at_);
    const std::string_view text = text_.substr(at_, end - at_);
    at_ = std::min(end, text_.size());
    return std::string(trimmed(text));
  }

  std::string quoted_field(std::size_t start) {
    const std::size_t opened = line_;
    std::string text;
    for (std::size_t at = start; at < text_.size(); ++at) {
      const bool closes = text_[at] == '"' && !text_.substr(at + 1).starts_with('"');
      if (closes) {
        at_ = std::min(text_.find_first_of(std::string{separator_, '\n'}, at), text_.size());
        if (!trimmed(text_.substr(at + 1, at_ - at - 1)).empty())
          throw InputError(file_, line_,
                           "there is text behind the closing quote of \"" + text + '"');
        return text;
      }
      if (text_[at] == '"') ++at;  // a doubled quote stands for one
      if (text_[at] == '\n') ++line_;
      text += text_[at];
    }
    throw InputError(file_, opened, "a quote is opened and not closed");
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  char separator_ = ',';
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace

CsvTable read_csv_table(const std::filesystem::path& file) {
  const std::string text = table_text(file);
  TableText records(file, text);
  std::optional<CsvTable::Line> header = records.next();
  if (!header) throw InputError(file, "is empty; a header line is expected");
  CsvTable table{.columns = std::move(header->fields)};
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i];
    const auto earlier = table.columns.begin() + static_cast<std::ptrdiff_t>(i);
    if (name.empty() || std::find(table.columns.begin(), earlier, name) != earlier) {
      throw InputError(file, header->line,
                       "column " + std::to_string(i + 1) + " is called \"" + name +
                           "\"; every column has a name of its own");
    }
  }
  while (std::optional<CsvTable::Line> line = records.next()) {
    if (line->fields.size() != table.columns.size()) {
      throw InputError(file, line->line,
                       "has " + std::to_string(line->fields.size()) + " fields; the header names " +
                           std::to_string(table.columns.size()));
    }
    table.lines.push_back(std::move(*line));
  }
  return table;
}

}  // namespace plotscan
