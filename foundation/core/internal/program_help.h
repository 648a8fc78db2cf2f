// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace plotscan {

// --help of every program: one paragraph per option, wrapped at 100 columns. Brackets after its
// description state whether it is required, its default, its range and what it excludes, unless the
// description says so itself.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

}  // namespace plotscan
