// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

int main(int argc, char** argv) {
  plotscan::Program program("farmbench",
                            "Benchmark plot and crop-height estimators on virtual farms.");
  plotscan::declare_run(program);
  plotscan::declare_plan(program);
  plotscan::declare_export(program);
  plotscan::declare_score(program);
  return program.run(argc, argv);
}
