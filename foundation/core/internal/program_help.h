// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace plotscan {

// --help of every program: an option a paragraph, wrapped at 100 columns. Behind its description
// stands in brackets whether it is required, its default, its range and what it excludes, each
// where the description itself does not say it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

}  // namespace plotscan
