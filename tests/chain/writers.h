// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <ostream>
#include <string>

#include "programs.h"
#include "temporary_folder.h"

namespace plotscan::testing {

// A command that writes.
struct Writer {
  std::string name;
  std::string command;  // up to its output; its inputs are in $IN
  std::string output;
};

void PrintTo(const Writer& writer, std::ostream* out);

inline auto writers() {
  return ::testing::Values(
      Writer{"Generate", "farmgen generate " + kFourPlots + " -q -o", "out"},
      Writer{"Plant", "farmgen plant maize -q -o", "out.obj"},
      Writer{"ExportClassic", "farmgen export $IN/farm --gazebo classic --drone -q -o", "out"},
      Writer{"ExportSim", "farmgen export $IN/farm --gazebo sim -q -o", "out"},
      Writer{"Fly", "lidarsim fly $IN/farm --speed 6 --format las,pcap,bag,mcap -q -o", "out"},
      Writer{"ConvertLas", "lidarsim convert $IN/scan -q", "out.las"},
      Writer{"ConvertBag", "lidarsim convert $IN/scan -q", "out.bag"},
      Writer{"View", "lidarsim view $IN/scan -q -o", "out.html"},
      Writer{"Run", "estimator run $IN/scan -q -o", "out"},
      Writer{"Score", "estimator score $IN/estimate --truth $IN/farm -q -o", "out"},
      Writer{"Series", "estimator series $IN/estimate $IN/estimate --dates a,b -q -o", "out"},
      Writer{"Report", "estimator report $IN/estimate -q -o", "out.html"},
      Writer{"ExportSuite", "farmbench export " + kSmokeSuite + " -q -o", "out"});
}

// Each of the writers, in a folder of its own; what they read is made once.
class Writing : public ::testing::TestWithParam<Writer> {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  // `before` and `after` are a shell's words around the command.
  Finished write(const std::string& before = "", const std::string& after = "") const;

  // The bytes of all files, by name, hidden ones too; folders have none.
  std::map<std::string, std::string> files() const;
  void remove() const;

  static inline std::filesystem::path input_;
  TemporaryFolder folder_;
};

}  // namespace plotscan::testing
