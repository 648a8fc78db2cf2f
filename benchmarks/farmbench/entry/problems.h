// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace plotscan::farmbench {

// Collects all errors of a submission, to report them together.
class Problems {
 public:
  // `where`: "3fa2.csv:4" or a file's name.
  void add(const std::string& where, const std::string& what);
  // Throws InputError with every problem (of more than 100, those and how many more there are),
  // naming `folder`; does nothing where there is none.
  void raise(const std::filesystem::path& folder) const;

 private:
  std::vector<std::string> kept_;  // at most 100
  std::size_t count_ = 0;
};

}  // namespace plotscan::farmbench
