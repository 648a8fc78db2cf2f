// SPDX-License-Identifier: Apache-2.0
#include "strata/plant_draw.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "core/yaml_section.h"

namespace plotscan::strata {
namespace {

constexpr double kTuft_m = 0.25;
// Plant seeds that fit a JSON number exactly.
constexpr std::uint64_t kSeeds = std::uint64_t{1} << 48;

// Cultivars of the given sizes, whose plants differ by the spread.
Overrides cultivars_of(const std::vector<double>& sizes, double spread) {
  std::string list;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    list += (i > 0 ? ", " : "") + std::string("{name: C") + std::to_string(i + 1) + ", scale: [" +
            text(sizes[i] * (1 - spread)) + ", " + text(sizes[i] * (1 + spread)) + "]}";
  return {"plants.cultivars=[" + list + "]", "plants.design=random"};
}

// In half of the fields: cultivars that are taller or shorter than the field's mean.
void draw_cultivars(double spread, RandomStream& random, Overrides& set) {
  if (!chance(random, 0.5)) return;
  const int count = draw_count(random, 4, 8);
  const double differ = random.uniform(0.05, 0.2);
  std::vector<double> sizes(static_cast<std::size_t>(count));
  std::ranges::generate(sizes, [&] { return 1 + differ * random.uniform(-1, 1); });
  std::ranges::copy(cultivars_of(sizes, spread), std::back_inserter(set));
}

void draw_scales(const Bounds& spreads, RandomStream& random, Overrides& set) {
  const double spread = draw(random, spreads);
  set.push_back("plants.scale=[" + text(1 - spread) + ", " + text(1 + spread) + "]");
  draw_cultivars(spread, random, set);
}

void set_drilled(int rows, RandomStream& random, Overrides& set) {
  set.push_back("plants.pattern=drilled");
  set.push_back("plants.drill_rows=" + std::to_string(rows));
  set.push_back("plants.jitter_m=" + text(random.uniform(0.005, 0.03)));
  set.push_back("plants.missing.rate=" + text(random.uniform(0, 0.1)));
}

}  // namespace

PlantRanges read_plant_ranges(const std::filesystem::path& file) {
  constexpr Range kAny{-1000, 1000};
  constexpr Range kPositive{0.01, 1000};
  const YamlSection document = YamlSection::load(file, {});
  PlantRanges ranges;
  for (const std::string& crop : document.keys()) {
    const YamlSection section = document.section(crop);
    ranges[crop].spread = section.pair("spread", {0, 0.5});
    const YamlSection parameters = section.section("parameters");
    for (const std::string& key : parameters.keys())
      ranges[crop].parameters[key] = parameters.pair(key, kAny);
    const YamlSection stages = section.section("stages");
    for (const std::string& stage : stages.keys())
      ranges[crop].stages.emplace_back(stage, stages.pair(stage, kPositive));
  }
  document.refuse_unread();
  return ranges;
}

std::string drawn_models(const std::string& crop, const std::string& stage,
                         const CropRanges& ranges, const std::string& fixed, RandomStream& random) {
  std::string values = fixed;
  for (const auto& [key, bounds] : ranges.parameters) {
    const double value = draw(random, bounds);
    values += (values.empty() ? "" : ", ") + key + "=" + text(value);
  }
  const int variants = draw_count(random, 3, 8);
  const std::uint64_t seed = random.below(kSeeds);
  return "[{crop: " + crop + ", stage: " + stage + ", seed: " + std::to_string(seed) +
         ", variants: " + std::to_string(variants) + ", set: [" + values + "]}]";
}

Overrides draw_plants(const std::string& crop, const CropRanges& ranges, const Sowing& sowing,
                      bool tufts, RandomStream& random) {
  const auto& [stage, density] = ranges.stages[random.below(ranges.stages.size())];
  Overrides set;
  const std::string fixed = tufts ? "tuft_m=" + text(kTuft_m) : "";
  set.push_back("plants.models=" + drawn_models(crop, stage, ranges, fixed, random));
  draw_scales(ranges.spread, random, set);
  if (chance(random, 0.2)) {
    set.push_back("plants.lodging.plots_rate=" + text(random.uniform(0.03, 0.12)));
    set.push_back("plants.lodging.angle_deg=[15, 50]");
  }
  if (sowing.drill_rows > 0) set_drilled(sowing.drill_rows, random, set);
  if (tufts) {
    const double per_row = std::max(1.0, std::round(sowing.length_m / kTuft_m));
    const double plants = per_row * sowing.drill_rows;
    set.push_back("plants.density_m2=" +
                  format_number(plants / (sowing.width_m * sowing.length_m)));
    set.push_back("plants.yaw=row");
  } else {
    set.push_back("plants.density_m2=" + text(draw(random, density)));
  }
  return set;
}

Overrides draw_panel(RandomStream& random) {
  constexpr double kSpread = 0.1;  // within a cultivar
  const int count = draw_count(random, 6, 10);
  const double differ = random.uniform(0.4, 0.65);
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) sizes.push_back(1 + differ * (2.0 * i / (count - 1) - 1));
  return cultivars_of(sizes, kSpread);
}

Overrides draw_meshes(const std::filesystem::path& folder, RandomStream& random) {
  struct Plant {
    const char* file;
    Bounds times;  // larger than the file has it: 0.14 to 0.22 m beans and 0.49 m maize are young
    Bounds density_m2;
  };
  static const std::array<Plant, 3> plants = {Plant{"bean/bean_medium.obj", {2, 4.5}, {14, 40}},
                                              Plant{"bean/bean_big.obj", {1.4, 3.2}, {12, 36}},
                                              Plant{"maize/maize_big_1.obj", {0.8, 2.2}, {7, 18}}};
  const Plant plant = pick(random, plants);
  return {"plants.models=[{mesh: '" + std::filesystem::absolute(folder / plant.file).string() +
              "', unit_m: " + text(draw(random, plant.times)) + "}]",
          "plants.scale=[0.7, 1.3]", "plants.density_m2=" + text(draw(random, plant.density_m2))};
}

}  // namespace plotscan::strata
