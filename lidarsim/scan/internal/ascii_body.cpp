// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"
#include "scan/internal/cloud_body.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes; a line is no longer

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The lines of a file from its current position, read in blocks.
class Lines {
 public:
  Lines(const std::filesystem::path& file, std::ifstream& in, std::size_t first_line)
      : file_(file), in_(in), line_(first_line - 1), block_(kBlock) {}

  // Gets the next line; false at the end of the file. The text is valid until the next call.
  bool next(std::string_view& text) {
    ++line_;
    for (;;) {
      const auto* begin = block_.data() + at_;
      const auto* end = static_cast<const char*>(std::memchr(begin, '\n', size_ - at_));
      if (end != nullptr) {
        text = {begin, static_cast<std::size_t>(end - begin)};
        at_ += text.size() + 1;
        return true;
      }
      if (!in_) break;
      refill();
    }
    text = {block_.data() + at_, size_ - at_};
    at_ = size_;
    return !text.empty();
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, line_, what); }

 private:
  void refill() {
    size_ -= at_;
    std::memmove(block_.data(), block_.data() + at_, size_);
    at_ = 0;
    if (size_ == block_.size()) fail("the line is too long");
    in_.read(block_.data() + size_, static_cast<std::streamsize>(block_.size() - size_));
    size_ += static_cast<std::size_t>(in_.gcount());
  }

  const std::filesystem::path& file_;
  std::ifstream& in_;
  std::size_t line_;
  std::vector<char> block_;
  std::size_t at_ = 0;    // of the next line in the block
  std::size_t size_ = 0;  // of what was read into it
};

void split_blanks(std::string_view line, std::vector<std::string_view>& columns) {
  const char* at = line.data();
  const char* end = at + line.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    const char* begin = at;
    while (at != end && !is_blank(*at)) ++at;
    columns.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
}

double parse_number(const Lines& lines, const CloudLayout& layout, std::string_view word) {
  if (const std::optional<double> number = number_of(word)) return *number;
  if (word.empty() && layout.may_lack_values) return std::numeric_limits<double>::quiet_NaN();
  lines.fail(in_quotes(word) + " is not a number" +
             (word.starts_with('"')                      ? "; numbers stand without quotes"
              : word.find(',') == std::string_view::npos ? ""
                                                         : "; decimals take a point"));
}

// Checks the counts that lines of one number promise (.pts) against the points that follow.
class Counts {
 public:
  void begin(const Lines& lines, std::string_view word, std::uint64_t read) {
    if (read < promised_)
      lines.fail(std::to_string(promised_) + " points are promised before this line, " +
                 std::to_string(read) + " are there");
    const auto count = parsed<std::uint64_t>(word);
    if (!count || *count > kMaxPoints)
      lines.fail("\"" + std::string(word) + "\" is neither a point nor a count of points");
    promised_ = read + *count;
  }
  std::uint64_t promised() const { return promised_; }

 private:
  std::uint64_t promised_ = 0;
};

void check_end(const std::filesystem::path& file, std::uint64_t promised, std::uint64_t read) {
  if (read >= promised) return;
  throw InputError(file, "is truncated: the header promises {} points, the file holds {}", promised,
                   read);
}

void check_columns(const Lines& lines, const CloudLayout& layout, std::size_t columns) {
  if (columns == layout.columns) return;
  lines.fail("has " + std::to_string(columns) + " values; " +
             (layout.is_text ? "the first point has " : "the header names ") +
             std::to_string(layout.columns));
}

}  // namespace

bool is_comment(std::string_view line) {
  line = without_blanks(line);
  return line.starts_with('#') || line.starts_with("//");
}

void split_columns(std::string_view line, char separator, std::vector<std::string_view>& columns) {
  columns.clear();
  if (separator == ' ') return split_blanks(line, columns);
  if (without_blanks(line).empty()) return;
  for (;;) {
    const std::size_t end = line.find(separator);
    columns.push_back(without_blanks(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> number_of(std::string_view word) {
  if (word == "NA") return std::numeric_limits<double>::quiet_NaN();  // R's missing value
  return parsed<double>(without_plus(word));
}

void read_ascii(const std::filesystem::path& file, std::ifstream& in, const CloudLayout& layout,
                const Wanted& wanted) {
  Lines lines(file, in, layout.body_line);
  Counts counts;
  std::string_view line;
  std::vector<std::string_view> columns;
  Rows rows(wanted);
  for (std::uint64_t read = 0; read < wanted.points;) {
    if (!lines.next(line)) {
      check_end(file, layout.is_text ? counts.promised() : layout.points, read);
      break;
    }
    if (layout.is_text && is_comment(line)) continue;
    split_columns(line, layout.separator, columns);
    if (columns.empty()) continue;
    if (layout.has_counts && columns.size() == 1) {
      counts.begin(lines, columns[0], read);
      continue;
    }
    check_columns(lines, layout, columns.size());
    for (const ScalarField& field : wanted.fields)
      rows.add(parse_number(lines, layout, columns[field.column]));
    rows.end_row();
    ++read;
  }
  rows.flush();
}

}  // namespace plotscan::scan
