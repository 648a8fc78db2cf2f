// SPDX-License-Identifier: Apache-2.0
#include "core/csv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/contains.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/parse.h"
#include "core/printable.h"
#include "core/text.h"

namespace plotscan {
namespace {

constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

// The whole text of a table. It must be UTF-8, since its values go into JSON.
std::string table_text(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  require_utf8(text, file);
  return std::string(without_byte_order_mark(text));
}

enum class Comments { kept, skipped };  // lines that begin with '#'

// Splits the whole text of a table into records, and these into fields. The first record is the
// header: it names the columns.
class TableText {
 public:
  TableText(const std::filesystem::path& file, Comments comments)
      : file_(file), text_(table_text(file)), comments_(comments) {
    skip_lines_without_fields();
    const std::string_view header = rest_of_line();
    for (const char separator : {'\t', ';', ','})
      if (header.find(separator) != std::string_view::npos) separator_ = separator;
  }

  // The next record; absent at the end of the text. InputError if it has not as many fields as the
  // first one.
  std::optional<CsvTable::Line> next() {
    skip_lines_without_fields();
    if (at_ >= text_.size()) return std::nullopt;
    CsvTable::Line record{.line = line_, .fields = {field()}};
    while (at_ < text_.size() && text_[at_] == separator_) {
      ++at_;
      record.fields.push_back(field());
    }
    ++at_;
    ++line_;
    if (columns_ == 0) columns_ = record.fields.size();
    if (record.fields.size() != columns_) {
      const bool more = separator_ == ',' && record.fields.size() > columns_;
      throw InputError(file_, record.line, "has {} fields; the header names {}{}",
                       record.fields.size(), columns_,
                       more ? "; where decimals have commas, separate fields by semicolons" : "");
    }
    return record;
  }

  Commas commas() const { return separator_ == ',' ? Commas::separate : Commas::decimal; }

 private:
  std::string_view rest_of_line() const {
    return std::string_view(text_).substr(at_, text_.find('\n', at_) - at_);
  }

  void skip_lines_without_fields() {
    while (at_ < text_.size()) {
      const std::string_view line = without_blanks(rest_of_line());
      const bool comment = comments_ == Comments::skipped && line.starts_with('#');
      if (!line.empty() && !comment) return;
      at_ = std::min(at_ + rest_of_line().size() + 1, text_.size());
      ++line_;
    }
  }

  // The field from at_ to the next separator or line end.
  std::string field() {
    const std::size_t start = text_.find_first_not_of(" \r", at_);
    if (start != std::string::npos && text_[start] == '"') return quoted_field(start + 1);
    const std::size_t end = text_.find_first_of(std::string{separator_, '\n'}, at_);
    const std::string_view text = std::string_view(text_).substr(at_, end - at_);
    at_ = std::min(end, text_.size());
    return std::string(without_blanks(text));
  }

  std::string quoted_field(std::size_t start) {
    const std::size_t opened = line_;
    std::string text;
    for (std::size_t at = start; at < text_.size(); ++at) {
      const bool closes = text_[at] == '"' && (at + 1 == text_.size() || text_[at + 1] != '"');
      if (closes) {
        at_ = std::min(text_.find_first_of(std::string{separator_, '\n'}, at), text_.size());
        if (!without_blanks(std::string_view(text_).substr(at + 1, at_ - at - 1)).empty())
          throw InputError(file_, line_, "there is text behind the closing quote of \"{}\"", text);
        return text;
      }
      if (text_[at] == '"') ++at;  // a doubled quote stands for one
      if (text_[at] == '\n') ++line_;
      text += text_[at];
    }
    throw InputError(file_, opened, "a quote is opened and not closed");
  }

  const std::filesystem::path& file_;
  const std::string text_;
  Comments comments_;
  char separator_ = ',';
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t columns_ = 0;
};

void require_own_names(const std::filesystem::path& file, const CsvTable::Line& header) {
  for (auto name = header.fields.begin(); name != header.fields.end(); ++name) {
    if (name->empty() || std::find(header.fields.begin(), name, *name) != name) {
      throw InputError(file, header.line,
                       "column {} is called \"{}\"; every column has a name of its own",
                       name - header.fields.begin() + 1, *name);
    }
  }
}

// For each wanted column its place in the file's header; kAbsent for a missing optional one.
std::vector<std::size_t> places_in_header(const std::filesystem::path& file,
                                          const CsvTable::Line& header,
                                          const std::vector<std::string>& wanted,
                                          std::size_t required) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto found = std::ranges::find(header.fields, wanted[i]);
    if (found == header.fields.end() && i < required)
      throw InputError(file, header.line, "column \"{}\" is missing", wanted[i]);
    places.push_back(found == header.fields.end()
                         ? kAbsent
                         : static_cast<std::size_t>(found - header.fields.begin()));
  }
  require_own_names(file, header);
  for (const std::string& name : header.fields) {
    if (!contains(wanted, name))
      throw InputError(file, header.line, "unknown column \"{}\"; known are {}", name,
                       joined(wanted, ","));
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
  return '"' + with_escapes(text, {{'"', "\"\""}}) + '"';
}

void CsvRow::fail(std::size_t column, const std::string& what) const {
  throw InputError(file_, line_, "{} \"{}\" {}", columns_[column], fields_[column], what);
}

double CsvRow::number(std::size_t column) const {
  std::string text(fields_[column]);
  const bool has_comma = text.find(',') != std::string::npos;
  if (commas_ == Commas::decimal && text.find('.') == std::string::npos)
    std::ranges::replace(text, ',', '.');
  const auto value = parsed<double>(text);
  if (!value && has_comma && commas_ == Commas::separate)
    fail(column, "is not a number: decimals have a point where commas separate fields");
  if (!value) fail(column, "is not a number");
  if (!std::isfinite(*value)) fail(column, "is not finite");
  return *value;
}

long long CsvRow::integer(std::size_t column, long long low, long long high) const {
  const auto value = parsed<long long>(fields_[column]);
  if (!value) fail(column, "is not a whole number");
  if (*value < low || *value > high) fail(column, "is not in [{}, {}]", low, high);
  return *value;
}

void read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
              const std::vector<std::string>& optional_columns,
              const std::function<void(const CsvRow&)>& row) {
  std::vector<std::string> wanted = columns;
  wanted.insert(wanted.end(), optional_columns.begin(), optional_columns.end());
  TableText records(file, Comments::skipped);
  const std::optional<CsvTable::Line> header = records.next();
  if (!header)
    throw InputError(file, "is empty; the header line {} is expected", joined(columns, ","));
  const std::vector<std::size_t> places = places_in_header(file, *header, wanted, columns.size());
  std::vector<std::string_view> fields(wanted.size());
  while (const std::optional<CsvTable::Line> record = records.next()) {
    for (std::size_t i = 0; i < places.size(); ++i)
      fields[i] = places[i] == kAbsent ? std::string_view() : record->fields[places[i]];
    row(CsvRow(file, record->line, wanted, fields, records.commas()));
  }
}

CsvTable read_csv_table(const std::filesystem::path& file) {
  TableText records(file, Comments::kept);
  std::optional<CsvTable::Line> header = records.next();
  if (!header) throw InputError(file, "is empty; a header line is expected");
  require_own_names(file, *header);
  CsvTable table{.columns = std::move(header->fields), .commas = records.commas()};
  while (std::optional<CsvTable::Line> line = records.next())
    table.lines.push_back(std::move(*line));
  return table;
}

}  // namespace plotscan
