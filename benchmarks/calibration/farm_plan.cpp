// SPDX-License-Identifier: Apache-2.0
#include "calibration/farm_plan.h"

#include <array>
#include <cmath>

#include "core/csv.h"
#include "core/random.h"
#include "core/yaml_section.h"

namespace plotscan::calibration {
namespace {

// The suites' seeds lie below 1000.
constexpr std::uint64_t kFirstSeed = 5000;
constexpr std::uint64_t kSeedsOfLibrary = 100;
// So that no two farms share a plant: a farm grows fewer.
constexpr std::uint64_t kPlantSeeds = 100;
constexpr std::size_t kMostLibraries = 1000;

double draw(RandomStream& random, const Bounds& range) {
  return random.uniform(range.first, range.second);
}

template <std::size_t Count>
double pick(RandomStream& random, const std::array<double, Count>& values) {
  return values[random.below(Count)];
}

std::string text(double value) { return format_number(value); }

std::string models_of(const Library& library, std::uint64_t seed, RandomStream& random) {
  std::string values;
  for (const auto& [key, value] : library.set) values += key + "=" + value + ", ";
  for (const auto& [key, bounds] : library.vary) {
    const double value = draw(random, bounds);
    if (!library.set.contains(key)) values += key + "=" + text(value) + ", ";
  }
  return "[{crop: " + library.crop + ", stage: " + library.stage +
         ", seed: " + std::to_string(kPlantSeeds * seed) +
         ", variants: " + text(std::round(draw(random, library.variants))) + ", set: [" + values +
         "]}]";
}

void plan_plants(const Library& library, std::uint64_t seed, double width_m, double length_m,
                 RandomStream& random, std::vector<std::string>& set) {
  const double spread = draw(random, library.spread);
  set.push_back("plants.scale=[" + text(1 - spread) + ", " + text(1 + spread) + "]");
  set.push_back("plants.models=" + models_of(library, seed, random));
  if (random.uniform() < 0.3) {
    set.push_back("plants.lodging.plots_rate=0.1");
    set.push_back("plants.lodging.angle_deg=[15, 50]");
  }
  if (library.density_m2.second > 0) {
    set.push_back("plants.density_m2=" + text(draw(random, library.density_m2)));
    return;
  }
  const double rows = std::max(1.0, std::round(width_m / draw(random, library.row_m)));
  set.push_back("plants.density_m2=" +
                text(rows * std::round(length_m / library.spacing_m) / (width_m * length_m)));
  set.push_back("plants.pattern=drilled");
  set.push_back("plants.drill_rows=" + text(rows));
  set.push_back("plants.jitter_m=0.02");
  set.push_back("plants.missing.rate=" + text(random.uniform(0, 0.1)));
  if (library.set.contains("tuft_m")) set.push_back("plants.yaw=row");
}

void plan_terrain(RandomStream& random, std::vector<std::string>& set) {
  set.push_back("terrain.relief_m=" + text(pick(random, std::array{0.0, 0.25, 0.5, 1.0})));
  // As many vertices per area as the paper's 150 on a square of 80 m, or of 40 m.
  set.push_back("terrain.vertices=" + text(pick(random, std::array{37.0, 37.0, 150.0})));
}

void plan_flight(RandomStream& random, lidar::FlyOptions& flight) {
  flight.range_noise_m = pick(random, std::array{0.0, 0.01, 0.02, 0.03, 0.03, 0.03, 0.05});
  flight.altitude_m = random.uniform(6.5, 13);
  flight.speed_m_s = random.uniform(1.5, 4);
  flight.spacing_m = random.uniform(3.5, 7);
  flight.heading_deg = random.uniform(0, 180);
  if (random.uniform() < 0.25) {
    flight.sub_rays = 7;
    flight.returns = random.uniform() < 0.5 ? "dual" : "strongest";
  }
  if (random.uniform() < 0.25) {
    flight.wind.mean_m_s = random.uniform(1, 4);
    flight.wind_acts_on = "plants";
  }
}

}  // namespace

std::vector<Library> read_libraries(const std::filesystem::path& file) {
  constexpr Range kAny{-1000, 1000};
  constexpr Range kPositive{0.01, 1000};
  const YamlSection document = YamlSection::load(file, {});
  const YamlSection crops = document.section("crops");
  std::vector<Library> libraries;
  for (const YamlSection& entry : document.list("libraries", kMostLibraries)) {
    entry.allow_only(
        {"name", "crop", "stage", "set", "density_m2", "row_m", "spacing_m", "spread", "variants"});
    Library library{
        .name = entry.text("name"), .crop = entry.text("crop"), .stage = entry.text("stage")};
    if (entry.has("set")) library.set = entry.section("set").texts();
    const YamlSection vary = crops.section(library.crop);
    for (const std::string& key : vary.keys()) library.vary[key] = vary.pair(key, kAny);
    if (entry.has("row_m")) {
      library.row_m = entry.pair("row_m", kPositive);
      library.spacing_m = entry.number("spacing_m", kPositive, library.spacing_m);
    } else {
      library.density_m2 = entry.pair("density_m2", kPositive);
    }
    library.spread = entry.pair("spread", {0, 0.5});
    library.variants = entry.pair("variants", {1, 100});
    libraries.push_back(std::move(library));
  }
  return libraries;
}

FarmPlan plan_farm(const Library& library, std::size_t library_number, int number) {
  FarmPlan plan{
      .library = library.name,
      .seed = kFirstSeed + kSeedsOfLibrary * library_number + static_cast<std::uint64_t>(number),
      .overrides = {},
      .flight = {}};
  RandomStream random(plan.seed, random_purpose("calibration/farm"), 0);
  const bool papers = random.uniform() < 0.5;
  const double width_m = papers ? 1.5 : random.uniform(1.0, 2.5);
  const double length_m = papers ? 4.0 : random.uniform(2.5, 6);
  plan.overrides = {"plots.width_m=" + text(width_m), "plots.length_m=" + text(length_m),
                    "plots.heading_deg=" + text(random.uniform(0, 180)),
                    "plots.gap_width_m=" + text(random.uniform(0.5, 1.2)),
                    "plots.gap_length_m=" + text(random.uniform(0.8, 1.5))};
  plan_plants(library, plan.seed, width_m, length_m, random, plan.overrides);
  plan_terrain(random, plan.overrides);
  plan_flight(random, plan.flight);
  plan.flight.seed = plan.seed;
  return plan;
}

}  // namespace plotscan::calibration
