// SPDX-License-Identifier: Apache-2.0
#include "calibration/farm_plan.h"

#include <array>
#include <cmath>

#include "core/csv.h"
#include "core/random.h"
#include "core/yaml_section.h"

namespace plotscan::calibration {
namespace {

constexpr std::uint64_t kSeedsOfLibrary = 100;
// Plant seeds reserved for each farm, so that no two farms share a plant; a farm grows fewer
// plants.
constexpr std::uint64_t kPlantSeeds = 100;
constexpr std::size_t kMostLibraries = 1000;

double draw(RandomStream& random, const Bounds& range) {
  return random.uniform(range.first, range.second);
}

template <class Value, std::size_t Count>
Value pick(RandomStream& random, const std::array<Value, Count>& values) {
  return values[random.below(Count)];
}

std::string text(double value) { return format_number(value); }

// A list of `variants` plants of their own seeds, with the crop's own parameters or drawn ones.
std::string models_of(const Library& library, std::uint64_t first_seed, RandomStream& random) {
  const bool usual = random.uniform() < 0.25;
  std::string values;
  for (const auto& [key, value] : library.set)
    values.append(key).append("=").append(value).append(", ");
  for (const auto& [key, bounds] : library.vary) {
    const double value = draw(random, bounds);
    if ((!usual || library.always.contains(key)) && !library.set.contains(key))
      values += key + "=" + text(value) + ", ";
  }
  return "[{crop: " + library.crop + ", stage: " + library.stage +
         ", seed: " + std::to_string(first_seed) +
         ", variants: " + text(std::round(draw(random, library.variants))) +
         (values.empty() ? "" : ", set: [" + values + "]") + "}]";
}

// Heights of plants that are stretched along z only, as if others had modelled them.
std::string heights_of(double mean_m, RandomStream& random) {
  return "{mean: " + text(mean_m) + ", sd: " + text(mean_m * random.uniform(0.02, 0.1)) + "}";
}

// One kind of plants for all plots, or 2 to 4 cultivars: of plants of their own, or of the same
// stretched to heights of their own.
void plan_plants(const Library& library, std::uint64_t seed, RandomStream& random,
                 std::vector<std::string>& set) {
  constexpr std::uint64_t kSeedsOfCultivar = 20;
  const double spread = draw(random, library.spread);
  const double vigour =
      library.vigour && random.uniform() < 0.35 ? draw(random, *library.vigour) : 1;
  set.push_back("plants.scale=[" + text(vigour * (1 - spread)) + ", " +
                text(vigour * (1 + spread)) + "]");
  const bool stretched = random.uniform() < 0.35 && library.height_m;
  const double height_m = library.height_m.value_or(0) * random.uniform(0.75, 1.35);
  set.push_back("plants.models=" + models_of(library, kPlantSeeds * seed, random));
  if (stretched) set.push_back("plants.height_m=" + heights_of(height_m, random));
  if (random.uniform() < 0.3) {
    const auto count = 2 + random.below(3);
    std::string cultivars;
    for (std::uint64_t i = 0; i < count; ++i) {
      cultivars += "{name: C" + std::to_string(i) + ", ";
      if (stretched) {
        cultivars += "height_m: " + heights_of(height_m * random.uniform(0.85, 1.15), random);
      } else if (i > 0) {
        cultivars += "models: " +
                     models_of(library, kPlantSeeds * seed + kSeedsOfCultivar * (i + 1), random);
      }
      cultivars += "}, ";
    }
    set.push_back("plants.cultivars=[" + cultivars + "]");
    set.push_back("plants.design=random");
  }
  if (random.uniform() < 0.2) {
    set.push_back("plants.lodging.plots_rate=0.1");
    set.push_back("plants.lodging.angle_deg=[15, 50]");
  }
}

// Rows along the plots' length, which their width is a multiple of.
double plan_rows(const Library& library, double width_m, double length_m, RandomStream& random,
                 std::vector<std::string>& set) {
  constexpr double kLeastRows = 2;
  const double row_m = draw(random, *library.row_m);
  const double rows = std::max(kLeastRows, std::round(width_m / row_m));
  const double seeds_of_row =
      library.spacing_m ? std::round(length_m / draw(random, *library.spacing_m))
                        : std::round(length_m * row_m * draw(random, *library.density_m2));
  set.push_back("plants.count=" + text(rows * std::max(1.0, seeds_of_row)));
  set.push_back("plants.pattern=drilled");
  set.push_back("plants.drill_rows=" + text(rows));
  set.push_back("plants.jitter_m=" + text(random.uniform(0, 0.03)));
  set.push_back("plants.missing.rate=" + text(random.uniform(0, 0.1)));
  if (library.set.contains("tuft_m")) set.push_back("plants.yaw=row");
  return rows * row_m;
}

void plan_plots(const Library& library, RandomStream& random, std::vector<std::string>& set) {
  const bool papers = random.uniform() < 0.5;
  double width_m = papers ? 1.5 : random.uniform(1.0, 2.6);
  const double length_m = papers ? 4.0 : random.uniform(2.5, 6);
  const bool drilled = library.row_m && (!library.density_m2 || random.uniform() < 0.5);
  if (drilled) {
    width_m = plan_rows(library, width_m, length_m, random, set);
  } else {
    set.push_back("plants.count=" +
                  text(std::round(width_m * length_m * draw(random, *library.density_m2))));
  }
  set.push_back("plots.width_m=" + text(width_m));
  set.push_back("plots.length_m=" + text(length_m));
  set.push_back("plots.heading_deg=" + text(random.uniform(0, 180)));
  set.push_back("plots.gap_width_m=" + text(random.uniform(0.2, 1.2)));
  set.push_back("plots.gap_length_m=" + text(random.uniform(0.5, 1.5)));
}

void plan_terrain(RandomStream& random, std::vector<std::string>& set) {
  set.push_back("terrain.relief_m=" +
                text(pick(random, std::array{0.0, 0.0, 0.25, 0.5, 0.5, 1.0})));
  // As many vertices per area as the paper's 150 on a square of 80 m, or of 40 m.
  set.push_back("terrain.vertices=" + text(pick(random, std::array{37.0, 37.0, 37.0, 150.0})));
}

// A third of the flights are lidarsim's own, the others of any sensor, height, speed and spacing.
void plan_path(RandomStream& random, lidar::FlyOptions& flight) {
  if (random.uniform() < 0.35) return;
  flight.altitude_m = random.uniform(6, 14);
  flight.speed_m_s = random.uniform(2.5, 6);
  flight.spacing_m = random.uniform(3.5, 8);
  flight.heading_deg = random.uniform(0, 180);
  if (random.uniform() < 0.5) return;
  flight.sensor =
      pick(random, std::array{"hdl32e", "os1_64", "puck_hires", "vlp32c", "livox_mid40"});
  flight.altitude_m = random.uniform(6, 20);
}

// Errors of a real survey: each kind in a quarter of the farms, all kinds together in a tenth.
void plan_errors(RandomStream& random, lidar::FlyOptions& flight) {
  constexpr double kShare = 0.25;
  const double all = random.uniform() < 0.1 ? 1 : 0;
  const auto happens = [&] { return random.uniform() < std::max(kShare, all); };
  flight.range_noise_m = pick(random, std::array{0.0, 0.01, 0.02, 0.03, 0.03, 0.03, 0.05});
  if (happens()) {
    flight.sub_rays = 7;
    flight.speed_m_s = std::max(flight.speed_m_s, 4.0);  // a beam costs as much as 7 rays
    flight.returns = pick(random, std::array{"strongest", "last", "dual", "dual"});
  }
  if (happens()) {
    flight.wind.mean_m_s = random.uniform(1, 5);
    flight.wind_acts_on = "plants";
  }
  if (happens()) {
    constexpr double kMost_deg = 0.1;
    flight.pose_error = random.uniform() < 0.7 ? "rtk" : "ppk";
    for (double& angle : flight.pose_errors.boresight_rpy_deg)
      angle = random.uniform(-kMost_deg, kMost_deg);
    flight.pose_errors.clock_offset_s = random.uniform(0, 0.002);
  }
}

}  // namespace

std::vector<Library> read_libraries(const std::filesystem::path& file, const std::string& ranges) {
  constexpr Range kAny{-1000, 1000};
  constexpr Range kPositive{0.01, 1000};
  constexpr Range kSeeds{1000, 1e6};  // the suites' seeds lie below
  const YamlSection document = YamlSection::load(file, {});
  const YamlSection drawn = document.section("ranges").section(ranges);
  const YamlSection crops = drawn.section("crops");
  std::vector<Library> libraries;
  for (const YamlSection& entry : document.list("libraries", kMostLibraries)) {
    entry.allow_only({"name", "crop", "stage", "height_m", "set", "vary", "density_m2", "row_m",
                      "spacing_m", "spread", "variants"});
    Library library{
        .name = entry.text("name"), .crop = entry.text("crop"), .stage = entry.text("stage")};
    if (entry.has("height_m")) library.height_m = entry.number("height_m", kPositive);
    if (entry.has("set")) library.set = entry.section("set").texts();
    const YamlSection vary = crops.section(library.crop);
    for (const std::string& key : vary.keys()) library.vary[key] = vary.pair(key, kAny);
    if (entry.has("vary")) {
      const YamlSection own = entry.section("vary");
      for (const std::string& key : own.keys()) {
        library.vary[key] = own.pair(key, kAny);
        library.always.insert(key);
      }
    }
    const auto range = [&](const char* key) {
      return entry.has(key) ? std::optional(entry.pair(key, kPositive)) : std::nullopt;
    };
    library.density_m2 = range("density_m2");
    library.row_m = range("row_m");
    library.spacing_m = range("spacing_m");
    library.spread = entry.pair("spread", {0, 0.5});
    library.variants = entry.pair("variants", {1, 100});
    if (drawn.has("vigour")) library.vigour = drawn.pair("vigour", kPositive);
    library.first_seed = static_cast<std::uint64_t>(drawn.number("first_seed", kSeeds));
    libraries.push_back(std::move(library));
  }
  return libraries;
}

FarmPlan plan_farm(const Library& library, std::size_t library_number, int number) {
  FarmPlan plan{.library = library.name,
                .seed = library.first_seed + kSeedsOfLibrary * library_number +
                        static_cast<std::uint64_t>(number),
                .overrides = {},
                .flight = {}};
  RandomStream random(plan.seed, random_purpose("calibration/farm"), 0);
  plan_plots(library, random, plan.overrides);
  plan_plants(library, plan.seed, random, plan.overrides);
  plan_terrain(random, plan.overrides);
  plan_path(random, plan.flight);
  plan_errors(random, plan.flight);
  plan.flight.seed = plan.seed;
  return plan;
}

}  // namespace plotscan::calibration
