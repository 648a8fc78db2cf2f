// SPDX-License-Identifier: Apache-2.0
// A flight's recordings, into the estimator as they are.
#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "programs.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using nlohmann::json;
using testing::run;

class Recordings : public testing::CommandsInAFolder {
 protected:
  json plots_of(const std::string& estimate) const {
    return json::parse(read_text(folder_.path() / estimate / "plots.geojson"))["features"];
  }
};

// The same plots and heights, within what the formats round: transforms and floats to micrometres;
// packets to 0.01 degrees (2 mm at 8 m) and 2 mm of range. A box that moves by a centimetre takes
// other leaves in, and the mean height with them.
TEST_F(Recordings, GiveThePlotsOfTheScan) {
  // Of plots with fewer plants the edges are too vague to stay within a centimetre.
  succeed("farmgen generate " + testing::kSmallFarm + " --set plants.count=60 -o farm --seed 101");
  succeed("lidarsim fly farm -o scan --format pcap,bag,mcap");
  succeed("estimator run scan -o scanned");
  const json truth = plots_of("scanned");
  ASSERT_EQ(truth.size(), 9u);
  struct Recording {
    std::string file, options;
    double most_m;  // what plots and heights may differ by
  };
  const std::vector<Recording> recordings = {
      {"scan/flight.bag", "", 0.002},
      {"scan/flight.mcap", "", 0.002},
      {"scan/flight.pcap", " --trajectory scan/poses.csv", 0.02}};
  for (const auto& [file, options, most_m] : recordings) {
    const std::string output = "of_" + file.substr(file.find('.') + 1);
    succeed("estimator run " + file + options + " -o " + output);
    const json plots = plots_of(output);
    ASSERT_EQ(plots.size(), truth.size()) << file;
    for (std::size_t i = 0; i < plots.size(); ++i) {
      for (const char* side : {"center_x_m", "center_y_m", "width_m", "length_m"}) {
        EXPECT_NEAR(plots[i]["properties"][side].get<double>(),
                    truth[i]["properties"][side].get<double>(), most_m)
            << file << ' ' << i << ' ' << side;
      }
      // Heights that are rounded have other ranks, and other pairs of them are compared.
      const double most_height_m = std::max(most_m, 0.01);
      for (const char* height : {"height_max_m", "height_mean_m", "canopy_p95_m"}) {
        EXPECT_NEAR(plots[i]["properties"][height].get<double>(),
                    truth[i]["properties"][height].get<double>(), most_height_m)
            << file << ' ' << i << ' ' << height;
      }
    }
    const json info = json::parse(succeed("estimator info --json " + file + options).output);
    EXPECT_EQ(info["can_carry_plots"], true) << file;
    EXPECT_EQ(info["time"]["first_utc"], "2026-06-01T10:00:00Z") << file;
    EXPECT_GT(info["points"], 2'000'000) << file;
  }
}

}  // namespace
}  // namespace plotscan
