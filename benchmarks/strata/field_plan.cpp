// SPDX-License-Identifier: Apache-2.0
#include "strata/field_plan.h"

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "core/list_of.h"
#include "lidar/fly_settings.h"
#include "strata/trials_side_by_side.h"

namespace plotscan::strata {
namespace {

// 64-bit FNV-1a.
std::uint64_t hash_of(const std::string& word) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

// A grid of plots, lengths in metres.
struct Layout {
  double width_m = 1.5;
  double length_m = 4;
  Bounds gap_width_m = {0.3, 1.5};
  Bounds gap_length_m = {0.3, 1.5};
  double missing_rate = 0.1;
  double alley_chance = 0.3;
  bool offsets = false;   // each row starts at a place of its own, and has its own number of plots
  int plots_of_pass = 0;  // beside which the drill's wheels leave tracks; 0: no tracks
};

struct Field {
  FieldPlan& plan;
  const Sources& sources;
  RandomStream& random;

  void set(const std::string& key, const std::string& value) const {
    plan.overrides.push_back(key + "=" + value);
  }
  void set(const std::string& key, double value) const { set(key, text(value)); }
  void set(const Overrides& more) const {
    plan.overrides.insert(plan.overrides.end(), more.begin(), more.end());
  }
};

// A wider gap after every so many columns.
std::string tracks(int plots_of_pass, int columns, double width_m) {
  std::string list;
  for (int after = plots_of_pass; after < columns; after += plots_of_pass)
    list += (list.empty() ? "" : ", ") + std::string("{after_column: ") + std::to_string(after) +
            ", width_m: " + text(width_m) + "}";
  return "[" + list + "]";
}

// 20 to 45 places: some are missing, and rows with offsets of their own have different numbers.
void draw_rows(const Field& field, const Layout& layout, double pitch_m) {
  const int rows = draw_count(field.random, 3, 5);
  const int columns = draw_count(field.random, (23 + rows - 1) / rows, std::min(11, 45 / rows));
  std::string list;
  for (int row = 0; row < rows; ++row) {
    const int plots =
        layout.offsets ? std::max(4, columns - draw_count(field.random, 0, 2)) : columns;
    const double offset_m = layout.offsets ? field.random.uniform(-1, 1) * pitch_m : 0;
    list += (row > 0 ? ", " : "") + std::string("{plots: ") + std::to_string(plots) +
            ", offset_m: " + text(offset_m) + "}";
  }
  field.set("plots.rows", "[" + list + "]");
  if (layout.plots_of_pass > 0)
    field.set("plots.alleys",
              tracks(layout.plots_of_pass, columns, field.random.uniform(0.5, 0.8)));
  if (!chance(field.random, layout.alley_chance)) return;
  const bool across = chance(field.random, 0.5);
  const int after = draw_count(field.random, 1, (across ? rows : columns) - 1);
  if (!across && layout.offsets) return;  // rows of different lengths have no common column
  field.set("plots.alleys", std::string("[{") + (across ? "after_row: " : "after_column: ") +
                                std::to_string(after) +
                                ", width_m: " + text(field.random.uniform(1.5, 3)) + "}]");
}

void draw_layout(const Field& field, const Layout& layout) {
  const double gap_m = draw(field.random, layout.gap_width_m);
  field.set("plots.width_m", format_number(layout.width_m));
  field.set("plots.length_m", format_number(layout.length_m));
  field.set("plots.gap_width_m", gap_m);
  field.set("plots.gap_length_m", draw(field.random, layout.gap_length_m));
  field.set("plots.heading_deg", field.random.uniform(0, 180));
  field.set("plots.missing_rate", layout.missing_rate);
  draw_rows(field, layout, layout.width_m + gap_m);
}

void draw_terrain(const Field& field) {
  field.set("terrain.relief_m", pick(field.random, std::array{0.0, 0.5, 1.0}));
}

// A flight as people fly, to a cloud of 2 to 5 million points.
void draw_flight(const Field& field) {
  lidar::FlyOptions& flight = field.plan.flight;
  flight.altitude_m = field.random.uniform(7, 12);
  flight.speed_m_s = field.random.uniform(2.5, 6);
  flight.spacing_m = field.random.uniform(5, 8);
  if (chance(field.random, 0.5)) flight.heading_deg = field.random.uniform(0, 180);
  flight.range_noise_m = pick(field.random, std::array{0.01, 0.02, 0.03, 0.03});
  field.plan.most_points = static_cast<std::size_t>(draw_count(field.random, 2'000'000, 5'000'000));
}

void sow(const Field& field, const std::string& crop, const Sowing& sowing, bool tufts) {
  const PlantRanges ranges = read_plant_ranges(field.sources.strata / "plants.yaml");
  field.set(draw_plants(crop, ranges.at(crop), sowing, tufts, field.random));
}

// Soybean or wheat on plots of 1.2 to 2 m by 3 to 6 m, at random or in closed drill rows.
void draw_small_grain(const Field& field, Layout layout) {
  Sowing sowing{.width_m = field.random.uniform(1.2, 2), .length_m = field.random.uniform(3, 6)};
  const bool wheat = chance(field.random, 0.5);
  const bool tufts = wheat && chance(field.random, 0.6);
  if (wheat || chance(field.random, 0.5)) {
    const Bounds spacing_m = wheat ? Bounds{0.12, 0.25} : Bounds{0.19, 0.5};
    sowing.drill_rows =
        std::max(2, static_cast<int>(std::round(sowing.width_m / draw(field.random, spacing_m))));
  }
  layout.width_m = sowing.width_m;
  layout.length_m = sowing.length_m;
  draw_layout(field, layout);
  sow(field, wheat ? "wheat" : "soybean", sowing, tufts);
  draw_terrain(field);
  draw_flight(field);
}

void ordinary(const Field& field) { draw_small_grain(field, {}); }

void offset(const Field& field) { draw_small_grain(field, {.alley_chance = 0, .offsets = true}); }

void touching(const Field& field) {
  constexpr Bounds kTouching = {0.2, 0.2};
  constexpr Bounds kApart = {0.5, 1.5};
  const int which = draw_count(field.random, 0, 2);
  draw_small_grain(field, {.gap_width_m = which == 1 ? kApart : kTouching,
                           .gap_length_m = which == 0 ? kApart : kTouching,
                           .alley_chance = 0});
}

void passes(const Field& field) {
  const int plots = 2 * draw_count(field.random, 1, 2);
  draw_small_grain(field, {.gap_width_m = {0.2, 0.4}, .alley_chance = 0, .plots_of_pass = plots});
}

// The sown width is the rows times their spacing: half a spacing beside the outer rows.
void drilled(const Field& field) {
  constexpr double kNarrowest_m = 0.6;
  const int rows = draw_count(field.random, 2, 5);
  const double spacing_m = field.random.uniform(std::max(0.19, kNarrowest_m / rows), 0.76);
  const Sowing sowing{
      .width_m = rows * spacing_m, .length_m = field.random.uniform(3, 6), .drill_rows = rows};
  draw_layout(field, {.width_m = sowing.width_m, .length_m = sowing.length_m});
  sow(field, "soybean", sowing, false);
  draw_terrain(field);
  draw_flight(field);
}

void maize(const Field& field) {
  const int rows = draw_count(field.random, 2, 4);
  const Sowing sowing{.width_m = rows * field.random.uniform(0.5, 1.0),
                      .length_m = field.random.uniform(3, 6),
                      .drill_rows = rows};
  draw_layout(field, {.width_m = sowing.width_m,
                      .length_m = sowing.length_m,
                      .gap_width_m = {0.5, 1.0},
                      .gap_length_m = {0.5, 1.0}});
  sow(field, "maize", sowing, false);
  draw_terrain(field);
  draw_flight(field);
  field.plan.flight.altitude_m += 2;
}

void draw_any(const Field& field) {
  using Draw = void (*)(const Field&);
  pick(field.random, std::array<Draw, 4>{ordinary, drilled, offset, maize})(field);
}

void objects(const Field& field) {
  draw_any(field);
  field.plan.beside = Beside::objects;
}

void border(const Field& field) {
  draw_any(field);
  field.plan.beside = Beside::border;
}

// Nothing shows where one plot ends and the next begins: breeding trials whose rows run on at one
// spacing. The estimator is given the width, and in half of the fields the length too.
void gapless(const Field& field) {
  draw_any(field);
  field.set("plots.gap_width_m", 0.0);
  field.plan.stated = chance(field.random, 0.5) ? Stated::width : Stated::sides;
}

// Cultivars from dwarfs to giants.
void panel(const Field& field) {
  draw_any(field);
  field.set(draw_panel(field.random));
}

// The same in a nursery, where nothing is left free between plots of a row: leaves of tall plots
// hang over short ones.
void nursery(const Field& field) {
  panel(field);
  field.set("plots.gap_width_m", 0.0);
  field.plan.stated = Stated::sides;
}

// As users cut their clouds before they measure.
void clipped(const Field& field) {
  draw_any(field);
  field.plan.margin_m = field.random.uniform(0, 2);
}

// Each trial has a crop, plots and gaps of its own.
void several(const Field& field) {
  std::vector<Overrides> trials;
  for (int count = chance(field.random, 0.75) ? 2 : 3; count > 0; --count) {
    FieldPlan alone;
    draw_any({alone, field.sources, field.random});
    trials.push_back(alone.overrides);
  }
  field.set(side_by_side(trials, field.plan.farm, field.random));
  field.plan.farm = field.sources.strata / "trials.yaml";
  draw_terrain(field);
  draw_flight(field);
  field.plan.flight.altitude_m += 2;  // as over maize
  *field.plan.most_points *= trials.size();
}

void others(const Field& field) {
  draw_layout(field,
              {.width_m = field.random.uniform(1.2, 2), .length_m = field.random.uniform(3, 6)});
  field.set(draw_meshes(field.sources.meshes, field.random));
  draw_terrain(field);
  draw_flight(field);
}

void sensors(const Field& field) {
  ordinary(field);
  static const std::array<std::string, 5> names = {"os1_64", "hdl32e", "vlp32c", "livox_mid40",
                                                   "puck_hires"};
  lidar::FlyOptions& flight = field.plan.flight;
  flight.sensor = names[static_cast<std::size_t>(field.plan.index) % names.size()];
  flight.altitude_m = field.random.uniform(6, 20);
  flight.speed_m_s = field.random.uniform(3.5, 6);
}

// The paper's farms are flown as in its suite: only the seed is drawn. This one is the last case of
// suites/realism.yaml.
void realism(const Field& field) {
  field.plan.farm = field.sources.worlds / "paper_half.yaml";
  lidar::FlyOptions& flight = field.plan.flight;
  flight.sub_rays = 7;
  flight.returns = "dual";
  flight.wind.mean_m_s = 4;
  flight.pose_error = "rtk";
  flight.pose_errors.boresight_rpy_deg.setConstant(0.05);
  flight.pose_errors.lever_arm_m.setConstant(0.01);
  flight.pose_errors.clock_offset_s = 0.001;
}

void kentland(const Field& field) {
  field.plan.farm = field.sources.worlds / "kentland.yaml";
  const PlantRanges ranges = read_plant_ranges(field.sources.strata / "plants.yaml");
  const std::string stage = pick(field.random, std::array<std::string, 2>{"Z65", "Z85"});
  field.set("plants.models", drawn_models("wheat", stage, ranges.at("wheat"),
                                          "tuft_m=0.25, tuft_plants_per_m=43", field.random));
}

void paper(const Field& field) {
  static const std::array<std::string, 3> terrains = {"flat", "half", "one"};
  const std::string& terrain = terrains[static_cast<std::size_t>(field.plan.index) % 3];
  field.plan.farm = field.sources.worlds / ("paper_" + terrain + ".yaml");
}

void steep(const Field& field) {
  field.plan.farm =
      field.sources.worlds / (field.plan.index % 2 == 0 ? "paper_half.yaml" : "paper_one.yaml");
  field.set("terrain.side_m", 40);
}

struct Stratum {
  std::string name;
  std::function<void(const Field&)> draw;
};

const std::vector<Stratum>& strata() {
  static const std::vector<Stratum> all = {
      {"ordinary", ordinary}, {"drilled", drilled}, {"offset", offset},   {"touching", touching},
      {"gapless", gapless},   {"passes", passes},   {"maize", maize},     {"panel", panel},
      {"objects", objects},   {"border", border},   {"clipped", clipped}, {"several", several},
      {"others", others},     {"realism", realism}, {"sensors", sensors}, {"kentland", kentland},
      {"paper", paper},       {"steep", steep},     {"nursery", nursery}};
  return all;
}

}  // namespace

nlohmann::json to_json(const FieldPlan& plan) {
  return {{"stratum", plan.stratum}, {"index", plan.index},
          {"seed", plan.seed},       {"farm", plan.farm.filename().string()},
          {"set", plan.overrides},   {"flight", lidar::settings_json(plan.flight)}};
}

const std::vector<std::string>& farm_strata() {
  static const std::vector<std::string> names = list_of<std::string>(strata(), &Stratum::name);
  return names;
}

RandomStream field_stream(const std::string& word, const std::string& stratum, int index) {
  return {hash_of(word), random_purpose("strata/" + stratum), static_cast<std::uint64_t>(index)};
}

FieldPlan plan_field(const std::string& word, const std::string& stratum, int index,
                     const Sources& sources) {
  const auto found = std::ranges::find(strata(), stratum, &Stratum::name);
  check(found != strata().end(), "no stratum " + stratum);
  RandomStream random = field_stream(word, stratum, index);
  FieldPlan plan{.stratum = stratum,
                 .index = index,
                 .seed = random.next_u32(),
                 .farm = sources.strata / "field.yaml"};
  plan.flight.seed = plan.seed;
  found->draw({plan, sources, random});
  return plan;
}

}  // namespace plotscan::strata
