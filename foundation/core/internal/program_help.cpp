// SPDX-License-Identifier: Apache-2.0
#include "core/internal/program_help.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "core/internal/program_declarations.h"
#include "core/text.h"

namespace plotscan {
namespace {

constexpr std::size_t kTextColumn = 28;
constexpr std::size_t kColumns = 100;

constexpr const char* kRange = " in [";

// CLI11's type name states a choice as "TEXT:{a,b}" and a range as "INT:INT in [0 - 255]"; a
// setting's states a range as "INT in [0, 255]".
std::string placeholder_of(const CLI::Option& option) {
  if (!takes_value(option)) return "";
  const std::string type = option.get_type_name();
  const std::string choices = joined(choices_of(option), ",");
  const std::size_t end = std::min(type.find(':'), type.find(kRange));
  std::string value = choices.empty() ? type.substr(0, end) : "{" + choices + "}";
  if (option.get_expected_max() == CLI::detail::expected_max_vector_size)
    value += "...";
  else if (option.get_expected_min() > 1)
    value += " x " + std::to_string(option.get_expected_min());
  return value;
}

std::string range_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(kRange);
  if (begin == std::string::npos) return "";
  const std::size_t low = begin + std::string(kRange).size();
  std::string range = type.substr(low, type.find(']', low) - low);
  for (const std::string between : {" - ", ", "}) {
    const std::size_t middle = range.find(between);
    if (middle != std::string::npos) return range.replace(middle, between.size(), " to ");
  }
  return "";
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);  // the set's order is that of their places in memory
  return joined(names, ", ");
}

std::string notes_of(const CLI::Option& option) {
  std::vector<std::string> notes;
  if (option.get_required() && !option.get_positional()) notes.push_back("required");
  const std::string range = range_of(option);
  if (!range.empty()) notes.push_back(range);
  const std::string usual = default_of(option);
  if (!usual.empty()) notes.push_back("default: " + usual);
  const std::string needed = names_of(option.get_needs());
  if (!needed.empty()) notes.push_back("only with " + needed);
  const std::string others = names_of(option.get_excludes());
  if (!others.empty()) notes.push_back("not with " + others);
  return notes.empty() ? "" : " [" + joined(notes, "; ") + "]";
}

// Wraps the text behind `begun`, which is already on the first line.
std::string wrapped(const std::string& begun, const std::string& text) {
  std::string page = begun;
  std::size_t column = begun.size();
  if (column + 2 > kTextColumn) {
    page += "\n";
    column = 0;
  }
  page.append(kTextColumn - column, ' ');
  column = kTextColumn;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool first = column == kTextColumn;
    if (!first && column + 1 + word.size() > kColumns) {
      page += "\n" + std::string(kTextColumn, ' ');
      column = kTextColumn;
    } else if (!first) {
      page += ' ';
      ++column;
    }
    page += word;
    column += word.size();
  }
  return page + "\n";
}

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string name = is_positional ? option->get_name(true) : joined(flags_of(*option), ",");
  const std::string value = is_positional ? "" : placeholder_of(*option);
  return wrapped("  " + name + (value.empty() ? "" : " " + value),
                 option->get_description() + notes_of(*option));
}

}  // namespace plotscan
