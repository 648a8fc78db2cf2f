// SPDX-License-Identifier: Apache-2.0
#include "writers.h"

#include <unistd.h>

#include "core/error.h"

namespace plotscan::testing {

namespace fs = std::filesystem;

void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.name; }

void Writing::SetUpTestSuite() {
  input_ = fs::temp_directory_path() / ("plotscan-writers-" + std::to_string(getpid()));
  fs::create_directories(input_);
  for (const std::string& command : {"farmgen generate " + kFourPlots + " -o farm",
                                     std::string("lidarsim fly farm -o scan --speed 6"),
                                     std::string("estimator run scan -o estimate")}) {
    ASSERT_EQ(run(command, input_).exit_code, 0) << command;
  }
}

void Writing::TearDownTestSuite() { fs::remove_all(input_); }

Finished Writing::write(const std::string& before, const std::string& after) const {
  return run("IN='" + input_.string() + "' && " + before + " " + GetParam().command + " " +
                 GetParam().output + " " + after,
             folder_.path());
}

std::map<std::string, std::string> Writing::files() const {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
    bytes[fs::relative(entry.path(), folder_.path())] =
        entry.is_regular_file() ? read_text(entry.path()) : "";
  return bytes;
}

void Writing::remove() const {
  for (const auto& entry : fs::directory_iterator(folder_.path())) fs::remove_all(entry.path());
}

}  // namespace plotscan::testing
