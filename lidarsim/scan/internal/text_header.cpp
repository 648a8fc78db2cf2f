// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>

#include "core/coordinate_units.h"
#include "core/error.h"
#include "core/text.h"
#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

// How many lines are searched for the first point.
constexpr std::size_t kMostHeaderLines = 100;
// std::regex recurs for each letter.
constexpr std::size_t kLongestNumber = 50;

// Names of x, y and z, as plain_column returns them. The first name that is found counts. Those
// with colons are ParaView's and VeloView's.
struct AxisNames {
  const char* axis;
  std::vector<std::string> names;
};

const std::array<AxisNames, 3>& axis_names() {
  static const std::array<AxisNames, 3> names = {
      {{"x",
        {"x", "xm", "xcoordinate", "easting", "eastingm", "east", "longitude", "lon", "long", "e",
         "pointsmxyz:0", "points:0"}},
       {"y",
        {"y", "ym", "ycoordinate", "northing", "northingm", "north", "latitude", "lat", "n",
         "pointsmxyz:1", "points:1"}},
       {"z",
        {"z", "zm", "zcoordinate", "elevation", "elevationm", "elev", "altitude", "altitudem",
         "alt", "height", "heightm", "up", "h", "pointsmxyz:2", "points:2"}}}};
  return names;
}

// "X [m]", "\"x\"" and "X_" are one name.
std::string plain_column(std::string_view name) {
  std::string plain;
  for (const char c : name.substr(0, name.find_first_of("[("))) {
    if (c != '_' && c != '"' && c != '\'' && c != ' ')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

// The words of letters in brackets behind a column's name, in lower case: "us" and "ft" of
// "X [US ft]".
std::vector<std::string> words_in_brackets(std::string_view name) {
  std::vector<std::string> words = {""};
  const std::size_t bracket = name.find_first_of("[(");
  if (bracket == std::string_view::npos) return words;
  for (const char c : name.substr(bracket)) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) != 0) {
      words.back() += static_cast<char>(std::tolower(letter));
    } else {
      words.emplace_back();
    }
  }
  return words;
}

// Metres in the unit in brackets behind a column's name; absent where no known length stands
// there.
std::optional<double> bracketed_unit(std::string_view name) {
  static const std::map<std::string, double> kLengths = {{"m", 1},
                                                         {"meter", 1},
                                                         {"meters", 1},
                                                         {"metre", 1},
                                                         {"metres", 1},
                                                         {"km", 1000},
                                                         {"cm", 0.01},
                                                         {"mm", 0.001},
                                                         {"ft", kFoot_m},
                                                         {"foot", kFoot_m},
                                                         {"feet", kFoot_m},
                                                         {"usft", kUsSurveyFoot_m},
                                                         {"ftus", kUsSurveyFoot_m}};
  const std::vector<std::string> words = words_in_brackets(name);
  const auto unit =
      std::ranges::find_if(words, [&](const auto& word) { return kLengths.contains(word); });
  if (unit == words.end()) return std::nullopt;
  const double unit_m = kLengths.at(*unit);
  const bool us =
      std::ranges::any_of(words, [](const auto& word) { return word == "us" || word == "survey"; });
  return us && unit_m == kFoot_m ? kUsSurveyFoot_m : unit_m;
}

// The separator of a line: semicolon, bar, comma, or ' ' for blanks (tabs count as blanks).
char separator_of(std::string_view line) {
  for (const char separator : {';', '|', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

// Below names, empty columns are values that were not measured.
bool is_point(const std::vector<std::string_view>& columns, bool below_names = false) {
  const auto numbers =
      std::ranges::count_if(columns, [](auto word) { return number_of(word).has_value(); });
  const auto empty = below_names && numbers > 0 ? std::ranges::count(columns, "") : 0;
  return numbers + empty >= 3;
}

// Whether the line is a point whose numbers have decimal commas.
bool has_decimal_commas(std::string_view line) {
  std::string pointed(line);
  std::ranges::replace(pointed, ',', '.');
  std::vector<std::string_view> columns;
  split_columns(pointed, separator_of(pointed), columns);
  return pointed != line && is_point(columns);
}

// Whether the line begins with three numbers, some of which have their thousands set off: 1,234.5
// or 4.600.000,25 or 4'600'000.
bool has_set_off_thousands(std::string_view line) {
  std::string words(line);
  std::ranges::replace_if(
      words, [](char c) { return c == ';' || c == '"'; }, ' ');
  std::vector<std::string_view> columns;
  split_columns(words, ' ', columns);
  static const std::regex kThousands(R"(,*[+-]?\d{1,3}([,.'])\d{3}(\1\d{3})*([.,]\d+)?,*)");
  static const std::regex kPlain(R"(,*[+-]?\d+([.,]\d+)?,*)");
  int numbers = 0;
  int set_off = 0;
  for (const std::string_view column : columns) {
    const std::string word(column);
    if (word == ",") continue;
    if (word.size() > kLongestNumber) return false;
    const bool has_thousands = std::regex_match(word, kThousands);
    if (!has_thousands && !std::regex_match(word, kPlain)) return false;
    if (has_thousands) ++set_off;
    if (++numbers == 3) return set_off > 0;
  }
  return false;
}

std::string_view without_quotes(std::string_view word) {
  const bool quoted = word.size() > 2 && word.front() == '"' && word.back() == '"';
  return quoted ? word.substr(1, word.size() - 2) : word;
}

// Whether the line is a point whose numbers are in quotes.
bool has_quoted_numbers(std::string_view line) {
  std::vector<std::string_view> columns;
  split_columns(line, separator_of(line), columns);
  std::ranges::transform(columns, columns.begin(), without_quotes);
  return is_point(columns);
}

// Throws InputError where the line is a point whose numbers are written in another way.
void refuse_other_numbers(const HeaderLines& lines, std::string_view line) {
  if (has_decimal_commas(line))
    lines.fail("has numbers with decimal commas; write them with points (sed 'y/,/./')");
  if (has_quoted_numbers(line))
    lines.fail("has numbers in quotes; write them without (sed 's/\"//g')");
  if (has_set_off_thousands(line))
    lines.fail("has numbers whose thousands are set off, such as 1,234.5; write them as 1234.5");
}

// The lines before the points, and the first point.
struct TextHeader {
  std::string first_point;
  bool has_count = false;  // one of the two lines before the points is one number
  std::string names;       // the last line with words, without a comment sign
  bool names_in_comment = false;
  std::size_t names_line = 0;
};

void take_header_line(const HeaderLines& lines, std::string_view line, TextHeader& header) {
  const bool comment = is_comment(line);
  const std::size_t begin = comment ? line.find_first_not_of("#/ \t") : 0;
  std::vector<std::string_view> words;
  split_columns(line, ' ', words);
  if (words.empty() || begin == std::string_view::npos) return;
  if (words.size() == 1 && number_of(words[0])) {
    header.has_count = true;
    return;
  }
  header.has_count = header.has_count && comment;  // the points begin after names
  header.names = line.substr(begin);
  header.names_in_comment = comment;
  header.names_line = lines.line();
}

TextHeader read_lines(const std::filesystem::path& file, HeaderLines& lines, CloudLayout& layout) {
  TextHeader header;
  std::vector<std::string_view> columns;
  while (lines.line() < kMostHeaderLines) {
    if (!header.has_count) {
      layout.body_offset = lines.offset();
      layout.body_line = lines.line() + 1;
    }
    const std::optional<std::string> text = lines.next_text();
    if (!text) break;
    const std::string_view line = without_byte_order_mark(*text);
    if (lines.line() == 1) layout.body_offset += text->size() - line.size();
    split_columns(line, separator_of(line), columns);
    if (!is_comment(line) && is_point(columns, !header.names.empty())) {
      header.first_point = line;
      return header;
    }
    if (!is_comment(line)) refuse_other_numbers(lines, line);
    take_header_line(lines, line, header);
  }
  throw InputError(file,
                   "is neither a PCD, nor a PLY, nor a LAS cloud, nor text: none of its first {} "
                   "lines is a point, x y z",
                   kMostHeaderLines);
}

// Whether a bracket that opens in the text is not closed.
bool has_open_bracket(std::string_view text) {
  const std::size_t opens = text.find_last_of("[(");
  return opens != std::string_view::npos &&
         text.find_first_of("])", opens) == std::string_view::npos;
}

// The words of a line with those in brackets joined to the name before them: "X", "[US" and "ft]"
// become "X [US ft]".
std::vector<std::string_view> with_brackets(const std::vector<std::string_view>& words) {
  std::vector<std::string_view> names;
  for (const std::string_view word : words) {
    const bool in_brackets = word.starts_with('[') || word.starts_with('(');
    if (!names.empty() && (in_brackets || has_open_bracket(names.back()))) {
      names.back() = {names.back().data(), word.data() + word.size()};
    } else {
      names.push_back(word);
    }
  }
  return names;
}

// The names of the columns, without quotes around them; empty if the header has none.
std::vector<std::string> column_names(const TextHeader& header, char separator) {
  std::vector<std::string_view> words;
  split_columns(header.names, separator, words);
  if (words.size() < 3) split_columns(header.names, separator_of(header.names), words);
  words = with_brackets(words);
  std::ranges::transform(words, words.begin(), without_quotes);
  return {words.begin(), words.end()};
}

// The indices of the columns named x, y and z; nothing unless all three are named.
std::optional<std::array<std::size_t, 3>> named_columns(const std::vector<std::string>& names) {
  std::vector<std::string> plain(names.size());
  std::ranges::transform(names, plain.begin(), plain_column);
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto found = plain.end();
    for (const std::string& name : axis_names()[axis].names)
      if (found == plain.end()) found = std::ranges::find(plain, name);
    if (found == plain.end()) return std::nullopt;
    columns[axis] = static_cast<std::size_t>(found - plain.begin());
  }
  return columns;
}

// Whether the names' places are those of the columns. Behind x, y and z, names may hold blanks, and
// a comment need not name all. R's tables have a first column that no name stands for.
bool fit(const TextHeader& header, std::size_t names, bool in_front,
         const std::vector<std::string_view>& columns) {
  if (!in_front) return names == columns.size();
  const std::size_t filled = columns.size() - (columns.back().empty() ? 1 : 0);
  return names == 0 || header.names_in_comment || names >= filled;
}

bool is_longitude(const std::string& name) {
  const std::vector<std::string> words = words_in_brackets(name);
  return plain_column(name).starts_with("lon") ||
         std::ranges::any_of(words, [](const auto& word) { return word.starts_with("deg"); });
}

// The units of the columns named x, y and z. What states none is in metres, z in the unit of x and
// y.
CoordinateUnits named_units(const std::filesystem::path& file, const TextHeader& header,
                            const std::vector<std::string>& names,
                            const std::array<std::size_t, 3>& xyz) {
  const std::optional<double> x_m = bracketed_unit(names[xyz[0]]);
  const std::optional<double> y_m = bracketed_unit(names[xyz[1]]);
  if (x_m && y_m && *x_m != *y_m) {
    throw InputError(file, header.names_line, "has x in {} and y in {}; both must be in one unit",
                     unit_name(*x_m), unit_name(*y_m));
  }
  const double horizontal_m = x_m.value_or(y_m.value_or(1));
  return {.horizontal_m = horizontal_m,
          .vertical_m = bracketed_unit(names[xyz[2]]).value_or(horizontal_m)};
}

// Adds every column as a field under its name; those of x, y and z get these names.
void add_fields(const std::vector<std::string>& names, const std::array<std::size_t, 3>& xyz,
                CloudLayout& layout) {
  for (std::size_t column = 0; column < layout.columns; ++column) {
    ScalarField field{.name = {}, .size = 8, .column = column};
    const auto axis = std::ranges::find(xyz, column);
    if (axis != xyz.end()) {
      field.name = axis_names()[static_cast<std::size_t>(axis - xyz.begin())].axis;
    } else if (names.size() == layout.columns) {
      field.name = names[column];
    }
    if (!field.name.empty()) layout.fields.push_back(std::move(field));
  }
}

}  // namespace

CloudLayout read_text_header(const std::filesystem::path& file) {
  HeaderLines lines(file);
  CloudLayout layout;
  layout.is_text = true;
  layout.points = kMaxPoints;
  const TextHeader header = read_lines(file, lines, layout);
  layout.has_counts = header.has_count;
  layout.format = "text";
  layout.separator = separator_of(header.first_point);
  std::vector<std::string_view> columns;
  split_columns(header.first_point, layout.separator, columns);
  layout.columns = columns.size();

  const std::vector<std::string> names = column_names(header, layout.separator);
  const auto named = named_columns(names);
  if (!named && !names.empty() && !header.names_in_comment) {
    throw InputError(
        file, header.names_line,
        "names the columns {}; x, y and z (or easting, northing and height) must be among them",
        joined(names, ", "));
  }
  const std::array<std::size_t, 3> xyz = named.value_or(std::array<std::size_t, 3>{0, 1, 2});
  const bool in_front = xyz == std::array<std::size_t, 3>{0, 1, 2};
  if (!fit(header, names.size(), in_front, columns)) {
    throw InputError(file, header.names_line, "names {} columns; the first point has {}",
                     names.size(), columns.size());
  }
  layout.may_lack_values = named && layout.separator != ' ';
  if (named) {
    layout.in_degrees = is_longitude(names[xyz[0]]);
    layout.units = named_units(file, header, names, xyz);
  }
  add_fields(names, xyz, layout);
  return layout;
}

}  // namespace plotscan::scan
