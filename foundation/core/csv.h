// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

namespace plotscan {

// The shortest text that reads back as the same number ("0.1", "1e-07"); "nan" for NaN.
std::string format_number(double value);

// The text as a field of a CSV line (RFC 4180): in quotes if it holds commas, quotes or line ends.
std::string csv_field(const std::string& text);

// What a table's file says of its commas.
enum class Commas {
  separate,  // fields
  decimal    // are decimal signs, as those of German and French spreadsheets
};

// One line of a table that is being read: its fields by column. Errors name file, line and column.
class CsvRow {
 public:
  CsvRow(const std::filesystem::path& file, std::size_t line,
         const std::vector<std::string>& columns, const std::vector<std::string_view>& fields,
         Commas commas)
      : file_(file), line_(line), columns_(columns), fields_(fields), commas_(commas) {}

  std::size_t line() const { return line_; }  // in the file, from 1
  std::string_view text(std::size_t column) const { return fields_[column]; }
  // A finite number, or InputError. Where commas are decimal, "71,5" is 71.5.
  double number(std::size_t column) const;
  // A whole number in [low, high], or InputError.
  long long integer(std::size_t column, long long low, long long high) const;
  // InputError naming file, line and the column's name.
  [[noreturn]] void fail(std::size_t column, const std::string& what) const;
  template <class... Arguments>
  [[noreturn]] void fail(std::size_t column, fmt::format_string<Arguments...> what,
                         Arguments&&... arguments) const {
    fail(column, fmt::vformat(what, fmt::make_format_args(arguments...)));
  }

 private:
  const std::filesystem::path& file_;
  std::size_t line_;
  const std::vector<std::string>& columns_;
  const std::vector<std::string_view>& fields_;
  Commas commas_;
};

// Tables are read as spreadsheets save them: a header line, fields between commas, or semicolons or
// tabs where the header has these and no comma (commas in numbers are then decimal signs), quotes
// as in RFC 4180. Blanks around fields and empty lines are skipped. InputError on a missing or
// empty file, a column without a name or named twice, a line with another number of fields, or an
// open quote.

// Calls `row` for each line of a table. Its fields are in the order of `columns`, then of
// `optional_columns` ("" where the table lacks them), whatever their order in the file. Lines that
// begin with '#' are skipped. Throws InputError on a missing or unknown column too.
void read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
              const std::vector<std::string>& optional_columns,
              const std::function<void(const CsvRow&)>& row);

// A whole table, with any columns; every field is kept as text.
struct CsvTable {
  struct Line {
    std::size_t line = 0;  // in the file, from 1
    std::vector<std::string> fields = {};
  };
  std::vector<std::string> columns = {};
  std::vector<Line> lines = {};
  Commas commas = Commas::separate;
};

CsvTable read_csv_table(const std::filesystem::path& file);

}  // namespace plotscan
