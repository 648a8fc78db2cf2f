// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

int main(int argc, char** argv) {
  plotscan::Program program("estimator", "Find plots in point clouds and measure crop heights.");
  plotscan::declare_run(program);
  plotscan::declare_info(program);
  plotscan::declare_score(program);
  plotscan::declare_series(program);
  plotscan::declare_report(program);
  return program.run(argc, argv);
}
