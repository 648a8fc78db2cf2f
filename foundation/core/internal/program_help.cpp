// SPDX-License-Identifier: Apache-2.0
#include "core/internal/program_help.h"

#include <algorithm>
#include <sstream>

#include "core/internal/program_declarations.h"
#include "core/text.h"

namespace plotscan {
namespace {

constexpr std::size_t kTextColumn = 28;
constexpr std::size_t kColumns = 100;

// The type's name without its choices and its range.
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
