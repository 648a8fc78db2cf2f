// SPDX-License-Identifier: Apache-2.0
#include "programs.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/wait.h>

namespace plotscan::testing {
namespace {

std::string take(const std::filesystem::path& file) {
  std::string text;
  {
    std::ifstream in(file, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  std::filesystem::remove(file);
  return text;
}

}  // namespace

Finished run(const std::string& command, const std::string& folder) {
  const std::string output = folder + ".stdout";
  const std::string errors = folder + ".stderr";
  const std::string line = "cd '" + folder + "' && PATH=" PLOTSCAN_PROGRAMS_DIR ":$PATH && { " +
                           command + "; } >'" + output + "' 2>'" + errors + "'";
  const int status = std::system(line.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .output = take(output),
          .errors = take(errors)};
}

}  // namespace plotscan::testing
